#include "load/view_client.h"

#include <algorithm>
#include <utility>

namespace radiata::client {
namespace {

// Updates that the server has not answered; at 30 Hz this is eight seconds of silence.
constexpr int kUnansweredMax = 256;
constexpr std::chrono::seconds kUpdateDeadline{5};

}  // namespace

struct ViewClient::UpdateCall {
    grpc::ClientContext context;
    v1::UpdateRequest request;
    v1::UpdateResponse response;
};

ViewClient::ViewClient(const std::shared_ptr<grpc::Channel>& channel, v1::OpenRequest open,
                       std::chrono::system_clock::time_point deadline)
    : stub_(v1::ViewService::NewStub(channel)), open_(std::move(open)) {
    context_.set_deadline(deadline);
    stub_->async()->Open(&context_, &open_, this);
    StartRead(&response_);
    StartCall();
}

ViewClient::~ViewClient() {
    close();
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return done_ && unanswered_ == 0; });
}

bool ViewClient::waitOpened(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [this] { return !view_id_.empty() || done_; });
    return !view_id_.empty() && !done_;
}

bool ViewClient::sendCamera(const v1::Camera& camera, std::uint64_t sequence) {
    v1::UpdateRequest request;
    *request.mutable_camera() = camera;
    {
        const std::lock_guard lock(mutex_);
        if (done_ || unanswered_ >= kUnansweredMax) return false;
        camera_sequence_ = sequence;
    }
    send(std::move(request));
    return true;
}

bool ViewClient::waitFrame(std::uint64_t sequence, std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    const auto arrived = [&] { return !frames_.empty() && frames_.back().camera_sequence >= sequence; };
    changed_.wait_for(lock, timeout, [&] { return arrived() || done_; });
    return arrived();
}

void ViewClient::close() {
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
    }
    context_.TryCancel();
}

std::vector<FrameRecord> ViewClient::frames() const {
    const std::lock_guard lock(mutex_);
    return frames_;
}

std::uint64_t ViewClient::failedUpdates() const {
    const std::lock_guard lock(mutex_);
    return failed_updates_;
}

grpc::Status ViewClient::status() const {
    const std::lock_guard lock(mutex_);
    return status_;
}

void ViewClient::OnReadDone(bool ok) {
    if (!ok) return;
    note(response_, LoadClock::now());
    StartRead(&response_);
}

void ViewClient::OnDone(const grpc::Status& status) {
    const std::lock_guard lock(mutex_);
    if (!closing_ && status_.ok()) {
        status_ = status.ok() ? grpc::Status(grpc::StatusCode::UNAVAILABLE, "the server ended the view") : status;
    }
    done_ = true;
    changed_.notify_all();
}

void ViewClient::note(const v1::OpenResponse& response, LoadClock::time_point arrival) {
    {
        const std::lock_guard lock(mutex_);
        if (!response.view_id().empty()) view_id_ = response.view_id();
        if (response.has_frame()) {
            const v1::Timing& timing = response.frame().timing();
            frames_.push_back({response.frame().camera_sequence(), arrival, timing.queue_ms(), timing.render_ms(),
                               timing.encode_ms(), timing.total_ms(), response.ByteSizeLong()});
            acknowledged_ = response.frame().sequence();
        }
        changed_.notify_all();
        if (!response.has_frame() || closing_) return;
    }
    send({});
}

void ViewClient::send(v1::UpdateRequest request) {
    const auto call = std::make_shared<UpdateCall>();
    call->request = std::move(request);
    call->context.set_deadline(std::min(context_.deadline(), std::chrono::system_clock::now() + kUpdateDeadline));
    {
        const std::lock_guard lock(mutex_);
        call->request.set_view_id(view_id_);
        call->request.set_acknowledged_sequence(acknowledged_);
        call->request.set_camera_sequence(camera_sequence_);
        ++unanswered_;
    }
    stub_->async()->Update(&call->context, &call->request, &call->response, [this, call](const grpc::Status& status) {
        const std::lock_guard lock(mutex_);
        --unanswered_;
        if (!status.ok() && !closing_) {
            ++failed_updates_;
            if (status_.ok()) status_ = status;
        }
        changed_.notify_all();
    });
}

}  // namespace radiata::client
