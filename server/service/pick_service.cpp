#include <algorithm>

#include "build/peaks.h"
#include "model/outline.h"
#include "service/convert.h"
#include "service/convert_checks.h"
#include "service/raw_call.h"
#include "service/services.h"

namespace radiata::service {
namespace {

/// The picture that the request names. Waits for nothing: the requests of a view's frames are kept.
template <typename Message>
model::FrameRequest pictureOf(const Message& message, session::Conductor& conductor, const ViewIds& ids) {
    switch (message.frame_case()) {
        case Message::kView:
            return conductor.requestOf(ids.find(message.view().view_id()), message.view().sequence());
        case Message::kRequest: {
            const model::FrameRequest request = fromProto(message.request(), "request");
            model::validate(request, conductor.limits());
            return request;
        }
        case Message::FRAME_NOT_SET:
            break;
    }
    refuse("view (a frame of a view) and request (a picture of its own) are both missing; give one");
}

}  // namespace

grpc::ServerUnaryReactor* PickService::Pick(Context*, const Bytes* request, Bytes* response) {
    return unaryCall<v1::PickRequest>(request, response, [this](UnaryCall* call, const v1::PickRequest& message) {
        const model::FrameRequest picture = pictureOf(message, conductor_, ids_);
        if (message.x() >= static_cast<std::uint32_t>(picture.width) ||
            message.y() >= static_cast<std::uint32_t>(picture.height)) {
            refuse("pixel " + std::to_string(message.x()) + ", " + std::to_string(message.y()) +
                   " lies outside the picture of " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                   " pixels, which count from 0");
        }
        const int x = static_cast<int>(message.x()), y = static_cast<int>(message.y());
        // The ray is traced by the render thread, peaks are searched by the worker, so that no view waits for them.
        const int radius = toInt(message.radius_px(), "radius_px");
        const bool all_hits = message.all_hits();
        if (all_hits) model::checkAllHits(picture);
        const auto trace = [this, call, picture, x, y, radius, all_hits] {
            try {
                auto found = conductor_.backend().pick(picture, x, y, radius, all_hits);
                if (!found) return call->answer(v1::PickResponse());
                worker_.post([call, picked = std::move(*found)]() mutable {
                    try {
                        if (auto* glyph = std::get_if<model::PickedGlyph>(&picked)) findPeaks(*glyph);
                        call->answer(toProto(picked));
                    } catch (...) {
                        call->refuse(currentStatus());
                    }
                });
            } catch (...) {
                call->refuse(currentStatus());
            }
        };
        afterLoading(call, picture, trace);
    });
}

void PickService::afterLoading(UnaryCall* call, const model::FrameRequest& picture, const std::function<void()>& task) {
    if (conductor_.backend().resident(picture)) return conductor_.post(task);
    worker_.post([this, call, picture, task] {
        try {
            conductor_.backend().load(picture);
            conductor_.post(task);
        } catch (...) {
            call->refuse(currentStatus());
        }
    });
}

grpc::ServerUnaryReactor* PickService::PickFibres(Context*, const Bytes* request, Bytes* response) {
    return unaryCall<v1::PickFibresRequest>(request, response, [this](UnaryCall* call, const v1::PickFibresRequest& message) {
        const model::FrameRequest picture = pictureOf(message, conductor_, ids_);
        std::vector<glm::dvec2> outline;
        for (const v1::PicturePoint& point : message.outline()) outline.emplace_back(point.x(), point.y());
        // Checked here, so that what is wrong waits for no turn.
        model::pixelsIn(outline, {picture.width, picture.height});
        const bool through = message.through();
        const std::size_t most = message.fibres_max();
        const auto find = [this, call, picture, outline, through, most] {
            try {
                v1::PickFibresResponse answer;
                for (const model::PickedFibres& picked : conductor_.backend().pick_fibres(picture, outline, through)) {
                    v1::PickedFibres& layer = *answer.add_layers();
                    layer.set_layer(static_cast<std::uint32_t>(picked.layer));
                    layer.set_dataset_id(picked.dataset_id);
                    layer.set_count(picked.fibres.size());
                    const auto named = static_cast<std::ptrdiff_t>(std::min(most, picked.fibres.size()));
                    layer.mutable_fibres()->Add(picked.fibres.begin(), picked.fibres.begin() + named);
                }
                call->answer(answer);
            } catch (...) {
                call->refuse(currentStatus());
            }
        };
        afterLoading(call, picture, find);
    });
}

}  // namespace radiata::service
