#include "cli/pictures.h"

#include "radiata/v1/render.grpc.pb.h"
#include "radiata/v1/view.grpc.pb.h"

#include "common/client_error.h"

namespace radiata::client {
namespace {

// A converged frame keeps the request of an earlier frame of the same view, where it was sent for the first time.
void rememberRequest(v1::Frame& frame, v1::FrameRequest& latest) {
    if (frame.has_request()) {
        latest = frame.request();
    } else {
        *frame.mutable_request() = latest;
    }
}

}  // namespace

v1::Frame renderPicture(const Connection& connection, const v1::FrameRequest& request, v1::ImageFormat format,
                        const std::vector<v1::Output>& outputs) {
    v1::RenderRequest call;
    *call.mutable_frame() = request;
    call.set_format(format);
    for (const v1::Output output : outputs) call.add_outputs(output);
    grpc::ClientContext context;
    connection.prepare(context);
    v1::RenderResponse response;
    connection.check(v1::RenderService::NewStub(connection.channel())->Render(&context, call, &response));
    return std::move(*response.mutable_frame());
}

v1::Frame streamPicture(const Connection& connection, const v1::FrameRequest& request,
                        const std::function<void(const v1::Frame&)>& seen) {
    const auto stub = v1::ViewService::NewStub(connection.channel());
    v1::OpenRequest open;
    *open.mutable_frame() = request;
    grpc::ClientContext context;
    connection.prepare(context);
    const auto reader = stub->Open(&context, open);
    v1::OpenResponse response;
    v1::FrameRequest resolved;
    std::string view_id;
    while (reader->Read(&response)) {
        if (!response.view_id().empty()) view_id = response.view_id();
        if (!response.has_frame()) continue;
        rememberRequest(*response.mutable_frame(), resolved);
        if (seen) seen(response.frame());
        if (response.frame().state() == v1::FRAME_STATE_CONVERGED) {
            context.TryCancel();
            return std::move(*response.mutable_frame());
        }
        v1::UpdateRequest update;
        update.set_view_id(view_id);
        update.set_acknowledged_sequence(response.frame().sequence());
        update.set_camera_sequence(response.frame().camera_sequence());
        grpc::ClientContext update_context;
        connection.prepare(update_context);
        v1::UpdateResponse ignored;
        connection.check(stub->Update(&update_context, update, &ignored));
    }
    connection.check(reader->Finish());
    throw ClientError(ExitCode::kUnreachable,
                      "server " + connection.address() + " ended the view before the picture came to rest");
}

}  // namespace radiata::client
