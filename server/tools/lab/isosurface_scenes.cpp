#include "tools/lab/isosurface_scenes.h"

namespace radiata::lab {

model::FrameRequest surfaceRequest(const model::ScalarImage& image, const std::string& dataset, std::optional<float> isovalue,
                                   int size, const glm::dvec3& towards) {
    model::FrameRequest request;
    request.width = request.height = size;
    request.quality.samples = 1;
    request.scene.annotations.hidden = true;
    request.scene.layers.emplace_back().content = model::IsosurfaceLayer{.dataset_id = dataset, .isovalue = isovalue};
    const glm::dvec3 edges = glm::dmat3(image.voxel_to_world) * glm::dvec3(image.size - 1);
    request.camera.target_mm = glm::dvec3(image.voxel_to_world * glm::dvec4(0.5 * glm::dvec3(image.size - 1), 1));
    request.camera.eye_mm = request.camera.target_mm + 1.3 * glm::length(edges) * glm::normalize(towards);
    request.camera.up = {0, 0, 1};
    request.camera.perspective = true;
    request.camera.field_of_view_deg = 36;
    return request;
}

}  // namespace radiata::lab
