#include "service/view_stream.h"

#include "radiata/v1/view.pb.h"
#include "service/convert.h"
#include "service/convert_checks.h"
#include "service/raw_call.h"
#include "service/status.h"

namespace radiata::service {
namespace {

constexpr int kWindow = 2;  // more frames under way only make pictures older on slow links

}  // namespace

ViewStream::ViewStream(session::Conductor& conductor, ViewIds& ids, const grpc::ByteBuffer& request)
    : conductor_(conductor), ids_(ids) {
    // Callbacks that come at once wait for this lock.
    const std::lock_guard lock(link_->mutex);
    link_->stream = this;
    // Without it a browser's fetch stays pending until the first frame.
    StartSendInitialMetadata();
    try {
        const auto message = parse<v1::OpenRequest>(request);
        if (!message.has_frame()) refuse("frame is missing");
        const int window = message.has_window() ? toInt(message.window(), "window") : kWindow;
        view_ = conductor_.open(fromProto(message.frame(), "frame"), window, callbacks());
        id_ = ids_.add(view_);
        v1::OpenResponse first;
        first.set_view_id(id_);
        write(serialize(first));
    } catch (...) {
        end_ = currentStatus();
        pump();
    }
}

session::ViewCallbacks ViewStream::callbacks() const {
    session::ViewCallbacks callbacks;
    callbacks.ready = [link = link_] {
        const std::lock_guard lock(link->mutex);
        if (link->stream) link->stream->pump();
    };
    callbacks.ended = [link = link_](const Error& error) {
        const std::lock_guard lock(link->mutex);
        if (link->stream) link->stream->end(toStatus(error));
    };
    return callbacks;
}

void ViewStream::end(const grpc::Status& status) {
    if (!end_) end_ = status;
    closeView();
    pump();
}

void ViewStream::closeView() {
    if (view_ != 0) conductor_.close(view_);
    if (!id_.empty()) ids_.remove(id_);
}

/// The next thing to do, unless a write is under way: then its end leads here.
void ViewStream::pump() {
    if (finished_ || writing_) return;
    if (!end_) {
        try {
            std::optional<session::StreamFrame> frame = conductor_.take(view_);
            if (!frame) return;
            v1::OpenResponse response;
            *response.mutable_frame() = toProto(std::move(*frame), {});
            write(serialize(response));
            return;
        } catch (...) {
            end_ = currentStatus();
            closeView();
        }
    }
    finished_ = true;
    Finish(*end_);
}

void ViewStream::write(grpc::ByteBuffer message) {
    message_ = std::move(message);
    writing_ = true;
    StartWrite(&message_);
}

void ViewStream::OnWriteDone(bool ok) {
    const std::shared_ptr<Link> link = link_;
    const std::lock_guard lock(link->mutex);
    writing_ = false;
    message_.Clear();
    if (!ok) return end(grpc::Status(grpc::StatusCode::CANCELLED, "the client is gone"));
    pump();
}

void ViewStream::OnCancel() {
    const std::shared_ptr<Link> link = link_;
    const std::lock_guard lock(link->mutex);
    end(grpc::Status(grpc::StatusCode::CANCELLED, "the client is gone"));
}

void ViewStream::OnDone() {
    {
        const std::shared_ptr<Link> link = link_;
        const std::lock_guard lock(link->mutex);
        closeView();
        link->stream = nullptr;
    }
    delete this;
}

}  // namespace radiata::service
