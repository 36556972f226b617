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
        if (!change.scene) {
            conductor_.update(view, change);
            call->answer(v1::UpdateResponse());
            return;
        }
        // A scene may name a dataset that is not there: that is found out before the view is touched, and may read a file.
        worker_.post([this, call, view, change] {
            try {
                for (const model::Layer& layer : change.scene->layers) {
                    conductor_.backend().info(layer.datasetId());
                    if (!layer.ifGlyphs() || layer.glyphs().colour.mode != model::ColourMode::kScalar) continue;
                    conductor_.backend().info(layer.glyphs().colour.image_id);
                }
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
