#include "service/service_fixture.h"

#include <cmath>

namespace radiata::service::testing {
namespace {

v1::OpenRequest openRequest(const v1::FrameRequest& frame) {
    v1::OpenRequest request;
    *request.mutable_frame() = frame;
    return request;
}

}  // namespace

v1::Camera camera(double angle) {
    v1::Camera message;
    message.mutable_eye_mm()->set_x(300 * std::cos(angle));
    message.mutable_eye_mm()->set_y(300 * std::sin(angle));
    message.mutable_target_mm();
    message.mutable_up()->set_z(1);
    message.set_height_mm(200);
    return message;
}

v1::FrameRequest frameRequest(double angle, std::uint32_t width, std::uint32_t height) {
    v1::FrameRequest frame;
    frame.mutable_scene()->add_layers()->mutable_glyphs()->set_dataset_id("stub");
    *frame.mutable_camera() = camera(angle);
    frame.set_width(width);
    frame.set_height(height);
    return frame;
}

Rig::Rig(session::Backend backend, session::Settings settings)
    : conductor(std::move(backend), std::move(settings)), server(conductor, ServerOptions{"", false, std::size_t{64} << 20}) {}

Rig::~Rig() { server.stop(); }

std::shared_ptr<grpc::Channel> Rig::channel() {
    grpc::ChannelArguments arguments;
    arguments.SetMaxReceiveMessageSize(-1);
    return server.inProcessChannel(arguments);
}

Viewer::Viewer(const std::shared_ptr<grpc::Channel>& channel, const v1::OpenRequest& request, Acknowledge acknowledge)
    : stub_(v1::ViewService::NewStub(channel)),
      reader_(stub_->Open(&context_, request)),
      thread_([this, acknowledge] { read(acknowledge); }) {}

Viewer::Viewer(const std::shared_ptr<grpc::Channel>& channel, const v1::FrameRequest& frame, Acknowledge acknowledge)
    : Viewer(channel, openRequest(frame), acknowledge) {}

Viewer::~Viewer() {
    cancel();
    thread_.join();
}

void Viewer::read(Acknowledge acknowledge) {
    v1::OpenResponse response;
    while (reader_->Read(&response)) {
        std::unique_lock lock(mutex_);
        if (!response.view_id().empty()) id_ = response.view_id();
        const std::string id = id_;
        const std::uint64_t sequence = response.frame().sequence();
        if (response.has_frame()) {
            ++received_;
            frames_.push_back(response.frame());
        }
        lock.unlock();
        changed_.notify_all();
        if (acknowledge == Acknowledge::kAll && sequence != 0) this->acknowledge(sequence);
    }
    const grpc::Status status = reader_->Finish();
    std::lock_guard lock(mutex_);
    status_ = status;
    ended_ = true;
    changed_.notify_all();
}

std::optional<v1::Frame> Viewer::waitFor(const std::function<bool(const v1::Frame&)>& wanted) {
    std::unique_lock lock(mutex_);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (true) {
        while (!frames_.empty()) {
            v1::Frame frame = std::move(frames_.front());
            frames_.pop_front();
            if (wanted(frame)) return frame;
        }
        if (ended_ || changed_.wait_until(lock, end) == std::cv_status::timeout) return std::nullopt;
    }
}

std::string Viewer::id() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(10), [this] { return !id_.empty() || ended_; });
    return id_;
}

std::size_t Viewer::received() {
    std::lock_guard lock(mutex_);
    return received_;
}

grpc::Status Viewer::update(const v1::UpdateRequest& change) {
    v1::UpdateRequest request = change;
    request.set_view_id(id());
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(10));
    v1::UpdateResponse response;
    return stub_->Update(&context, request, &response);
}

grpc::Status Viewer::move(std::uint64_t camera_sequence, double angle) {
    v1::UpdateRequest change;
    change.set_camera_sequence(camera_sequence);
    *change.mutable_camera() = camera(angle);
    return update(change);
}

grpc::Status Viewer::acknowledge(std::uint64_t sequence) {
    v1::UpdateRequest change;
    change.set_acknowledged_sequence(sequence);
    return update(change);
}

grpc::Status Viewer::end() {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, std::chrono::seconds(10), [this] { return ended_; })) << "the stream did not end";
    return status_;
}

}  // namespace radiata::service::testing
