#include "service/convert.h"
#include "service/raw_call.h"
#include "service/services.h"
#include "service/view_stream.h"

namespace radiata::service {

grpc::ServerWriteReactor<Bytes>* ViewService::Open(Context*, const Bytes* request) {
    return new ViewStream(conductor_, ids_, *request);
}

grpc::ServerUnaryReactor* ViewService::Update(Context*, const Bytes* request, Bytes* response) {
    return unaryCall<v1::UpdateRequest>(request, response, [this](UnaryCall* call, const v1::UpdateRequest& message) {
        const std::uint64_t view = ids_.find(message.view_id());
        const session::Change change = fromProto(message);
        model::FrameRequest probe;
        if (change.scene) probe.scene = *change.scene;
        if (!change.scene || conductor_.backend().resident(probe)) {
            conductor_.update(view, change);
            call->answer(v1::UpdateResponse());
            return;
        }
        // A dataset that turns out to be broken is found out before the view is touched.
        worker_.post([this, call, view, change, probe] {
            try {
                conductor_.backend().load(probe);
                conductor_.update(view, change);
            } catch (...) {
                call->refuse(currentStatus());
                return;
            }
            call->answer(v1::UpdateResponse());
        });
    });
}

}  // namespace radiata::service
