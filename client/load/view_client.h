// One client of the load: a live view whose frames are noted and acknowledged as they arrive. All calls are asynchronous, so
// that many clients need no threads of their own.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <grpcpp/grpcpp.h>

#include "radiata/v1/view.grpc.pb.h"

namespace radiata::client {

using LoadClock = std::chrono::steady_clock;

struct FrameRecord {
    std::uint64_t camera_sequence = 0;
    LoadClock::time_point arrival;                                    ///< parsed and in the program's hands
    double queue_ms = 0, render_ms = 0, encode_ms = 0, total_ms = 0;  ///< on the server
    std::size_t bytes = 0;                                            ///< of the message
};

class ViewClient : public grpc::ClientReadReactor<v1::OpenResponse> {
public:
    /// \param deadline  of the view and of every call; nothing lives longer
    ViewClient(const std::shared_ptr<grpc::Channel>& channel, v1::OpenRequest open,
               std::chrono::system_clock::time_point deadline);
    /// Cancels and waits for the end of every call.
    ~ViewClient() override;

    /// Waits for the view's id. \return false if the view ended instead, or the time is up
    bool waitOpened(std::chrono::milliseconds timeout);
    /// \param sequence  rises from 1. \return false, and sends nothing, if too many updates are unanswered or the view has
    /// ended
    bool sendCamera(const v1::Camera& camera, std::uint64_t sequence);
    /// Waits until a frame of this camera has arrived. \return false if the time is up first
    bool waitFrame(std::uint64_t sequence, std::chrono::milliseconds timeout);
    void close();

    std::vector<FrameRecord> frames() const;
    std::uint64_t failedUpdates() const;
    /// Why the view ended or an update failed; OK if all went well.
    grpc::Status status() const;

private:
    struct UpdateCall;

    void OnReadDone(bool ok) override;
    void OnDone(const grpc::Status& status) override;
    void send(v1::UpdateRequest request);
    void note(const v1::OpenResponse& response, LoadClock::time_point arrival);

    std::unique_ptr<v1::ViewService::Stub> stub_;
    grpc::ClientContext context_;
    v1::OpenRequest open_;
    v1::OpenResponse response_;

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::string view_id_;
    std::vector<FrameRecord> frames_;
    std::uint64_t acknowledged_ = 0;
    std::uint64_t camera_sequence_ = 0;
    std::uint64_t failed_updates_ = 0;
    int unanswered_ = 0;
    bool closing_ = false;
    bool done_ = false;
    grpc::Status status_;
};

}  // namespace radiata::client
