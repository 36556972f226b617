// A server with a stub renderer behind an in-process channel, and a client that follows one view.
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include "radiata/v1/catalog.grpc.pb.h"
#include "radiata/v1/limits.grpc.pb.h"
#include "radiata/v1/render.grpc.pb.h"
#include "radiata/v1/view.grpc.pb.h"
#include "service/server.h"
#include "session/stub_backend.h"

namespace radiata::service::testing {

using std::chrono::milliseconds;

/// A valid request for a small picture of the stub's dataset, seen from the angle.
v1::FrameRequest frameRequest(double angle = 0, std::uint32_t width = 96, std::uint32_t height = 64);
v1::Camera camera(double angle);

/// Backend, conductor and server together.
struct Rig {
    explicit Rig(session::Backend backend = session::stubBackend(milliseconds(1)), session::Settings settings = {});
    ~Rig();
    std::shared_ptr<grpc::Channel> channel();

    session::Conductor conductor;
    Server server;
};

/// The client's side of one view: a thread reads, and acknowledges what it read if asked to.
class Viewer {
public:
    enum class Acknowledge { kAll, kNone };
    Viewer(const std::shared_ptr<grpc::Channel>& channel, const v1::OpenRequest& request, Acknowledge acknowledge);
    Viewer(const std::shared_ptr<grpc::Channel>& channel, const v1::FrameRequest& frame,
           Acknowledge acknowledge = Acknowledge::kAll);
    /// Cancels and waits for the end.
    ~Viewer();

    /// The first frame not looked at yet for which `wanted` holds, within 10 s; nothing if there is none or the stream ended.
    std::optional<v1::Frame> waitFor(const std::function<bool(const v1::Frame&)>& wanted);
    /// Waits for the view's id.
    std::string id();
    std::size_t received();
    grpc::Status update(const v1::UpdateRequest& change);
    grpc::Status move(std::uint64_t camera_sequence, double angle);
    grpc::Status acknowledge(std::uint64_t sequence);
    void cancel() { context_.TryCancel(); }
    /// How the stream ended; waits for it.
    grpc::Status end();

private:
    void read(Acknowledge acknowledge);

    std::unique_ptr<v1::ViewService::Stub> stub_;
    grpc::ClientContext context_;
    std::unique_ptr<grpc::ClientReader<v1::OpenResponse>> reader_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<v1::Frame> frames_;
    std::size_t received_ = 0;
    std::string id_;
    bool ended_ = false;
    grpc::Status status_;
    std::thread thread_;
};

}  // namespace radiata::service::testing
