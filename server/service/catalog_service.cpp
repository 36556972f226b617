#include <cmath>

#include "service/convert.h"
#include "service/convert_checks.h"
#include "service/raw_call.h"
#include "service/services.h"

namespace radiata::service {
namespace {

constexpr double kAspectMin = 0.05;
constexpr double kAspectMax = 20;

/// Runs `work()` for its answer, wherever it is called.
template <typename Work>
void answerWith(UnaryCall* call, Work&& work) {
    try {
        call->answer(work());
    } catch (...) {
        call->refuse(currentStatus());
    }
}

/// model::validate looks at whole requests: this one is valid but for the selection.
void checkSelection(const std::string& dataset_id, const model::VoxelSelection& selection) {
    model::FrameRequest request;
    request.scene.layers.emplace_back();
    request.scene.layers[0].glyphs().dataset_id = dataset_id;
    request.scene.layers[0].glyphs().selection = selection;
    try {
        model::validate(request, {});
    } catch (const Error& error) {
        const std::string prefix = "scene.layers[0].glyphs.";
        std::string sentence = error.what();
        if (sentence.starts_with(prefix)) sentence.erase(0, prefix.size());
        throw Error(error.code(), sentence);
    }
}

}  // namespace

grpc::ServerUnaryReactor* CatalogService::ListDatasets(Context*, const Bytes* request, Bytes* response) {
    return unaryCall<v1::ListDatasetsRequest>(request, response, [this](UnaryCall* call, const v1::ListDatasetsRequest&) {
        worker_.post([this, call] {
            answerWith(call, [this] {
                v1::ListDatasetsResponse answer;
                for (const model::DatasetInfo& info : conductor_.backend().list()) *answer.add_datasets() = toProto(info);
                return answer;
            });
        });
    });
}

grpc::ServerUnaryReactor* CatalogService::GetDataset(Context*, const Bytes* request, Bytes* response) {
    return unaryCall<v1::GetDatasetRequest>(request, response, [this](UnaryCall* call, const v1::GetDatasetRequest& message) {
        loads_.post([this, call, id = message.id()] {
            answerWith(call, [this, &id] {
                v1::GetDatasetResponse answer;
                *answer.mutable_dataset() = toProto(conductor_.backend().info(id));
                return answer;
            });
        });
    });
}

grpc::ServerUnaryReactor* CatalogService::FitCamera(Context*, const Bytes* request, Bytes* response) {
    return unaryCall<v1::FitCameraRequest>(request, response, [this](UnaryCall* call, const v1::FitCameraRequest& message) {
        const model::VoxelSelection selection = fromProto(message.selection(), "selection");
        const model::Convention convention = fromProto(message.convention(), "convention");
        const double aspect = message.aspect();
        if (!(aspect >= kAspectMin && aspect <= kAspectMax)) {
            refuse("aspect is " + std::to_string(aspect) + "; it must be 0.05 to 20");
        }
        checkSelection(message.dataset_id(), selection);
        // The renderer knows what a selection covers, and only its own thread may ask it; that the dataset is there when it
        // does is for others to see to.
        const auto fit = [this, call, selection, convention, aspect, id = message.dataset_id()] {
            answerWith(call, [&] {
                v1::FitCameraResponse answer;
                *answer.mutable_camera() = toProto(conductor_.backend().fit_camera(id, selection, convention, aspect));
                return answer;
            });
        };
        model::FrameRequest probe;
        probe.scene.layers.emplace_back().glyphs().dataset_id = message.dataset_id();
        if (conductor_.backend().resident(probe)) return conductor_.post(fit);
        loads_.post([this, call, fit, probe] {
            try {
                conductor_.backend().load(probe);
                conductor_.post(fit);
            } catch (...) {
                call->refuse(currentStatus());
            }
        });
    });
}

grpc::ServerUnaryReactor* LimitsService::GetLimits(Context*, const Bytes* request, Bytes* response) {
    return unaryCall<v1::GetLimitsRequest>(request, response, [this](UnaryCall* call, const v1::GetLimitsRequest&) {
        call->answer(toProto(conductor_.limits(), conductor_.backend()));
    });
}

}  // namespace radiata::service
