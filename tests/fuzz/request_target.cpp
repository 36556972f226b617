// Any bytes given to the service as a request: they are refused with a sentence, or become a request that the checks accept,
// that is equal to itself and to its own echo, and that planning can be done with. The first byte chooses the message.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "plan/annotations.h"
#include "plan/camera_rays.h"
#include "service/convert.h"

namespace {

using namespace radiata;

void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "broken: %s\n", what);
    std::abort();
}

model::FrameRequest base() {
    model::FrameRequest request;
    request.scene.layers.emplace_back().glyphs().dataset_id = "base";
    return request;
}

void checkAccepted(const model::FrameRequest& request) {
    model::validate(request, {});
    require(request == request, "a request is equal to itself, or a picture of it could not be continued");
    require(service::fromProto(service::toProto(request), "frame") == request, "the echo is the request");
    plan::rebaseCamera(request.camera, {glm::dvec3(-100), glm::dvec3(100)}, request.height);
    require(request.scene.annotations.hidden || !plan::annotations(request, model::FrameState::kRefining, 1, {1, 2}).empty(),
            "marks on the picture");
}

void readRender(const std::string& bytes) {
    v1::RenderRequest message;
    if (!message.ParseFromString(bytes)) return;
    const model::FrameRequest request = service::fromProto(message.frame(), "frame");
    service::outputsFromProto(message);
    service::formatFromProto(message.format(), "format");
    checkAccepted(request);
}

void readOpen(const std::string& bytes) {
    v1::OpenRequest message;
    if (message.ParseFromString(bytes)) checkAccepted(service::fromProto(message.frame(), "frame"));
}

void readUpdate(const std::string& bytes) {
    v1::UpdateRequest message;
    if (!message.ParseFromString(bytes)) return;
    const session::Change change = service::fromProto(message);
    model::FrameRequest request = base();
    if (change.camera) request.camera = *change.camera;
    if (change.scene) request.scene = *change.scene;
    if (change.quality) request.quality = *change.quality;
    if (change.size) {
        request.width = change.size->width;
        request.height = change.size->height;
    }
    checkAccepted(request);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        switch (data[0] % 3) {
            case 0:
                readRender(bytes);
                break;
            case 1:
                readOpen(bytes);
                break;
            default:
                readUpdate(bytes);
                break;
        }
    } catch (const radiata::Error& error) {
        require(error.code() == Code::kInvalidArgument || error.code() == Code::kResourceExhausted,
                "what is refused is the caller's fault");
        require(std::string(error.what()).size() > 10, "a sentence");
    }
    return 0;
}
