// The stream of one view: one write under way, the newest frame taken when it is done.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <grpcpp/grpcpp.h>
#include <grpcpp/support/server_callback.h>

#include "service/view_ids.h"
#include "session/conductor.h"

namespace radiata::service {

/// Deletes itself when gRPC is through with it.
class ViewStream final : public grpc::ServerWriteReactor<grpc::ByteBuffer> {
public:
    /// Opens the view and writes its id. A refused request ends the stream with its status. Conductor and ids must outlive it.
    ViewStream(session::Conductor& conductor, ViewIds& ids, const grpc::ByteBuffer& request);

    void OnWriteDone(bool ok) override;
    void OnCancel() override;
    void OnDone() override;

private:
    /// What callbacks of the conductor hold: they may come when the stream is gone already.
    struct Link {
        std::mutex mutex;
        ViewStream* stream = nullptr;
    };

    session::ViewCallbacks callbacks() const;
    void end(const grpc::Status& status);
    void pump();
    void write(grpc::ByteBuffer message);
    void closeView();

    session::Conductor& conductor_;
    ViewIds& ids_;
    std::shared_ptr<Link> link_ = std::make_shared<Link>();

    // Guarded by link_->mutex.
    std::uint64_t view_ = 0;
    std::string id_;
    grpc::ByteBuffer message_;  ///< under way; must outlive its write
    bool writing_ = false;
    bool finished_ = false;
    std::optional<grpc::Status> end_;
};

}  // namespace radiata::service
