#include "plan/plan_illumination.h"

#include "plan/plan_isosurface.h"

namespace radiata::plan {

void planIllumination(FramePlan& plan) {
    const model::Scene& scene = plan.resolved.scene;
    if (!scene.light.illumination) return;
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        const model::IsosurfaceLayer* surface = scene.layers[i].ifSurface();
        if (surface == nullptr || isVeil(scene.layers[i]) || surface->shading != model::SurfaceShading::kScene) continue;
        const std::string suffix = scene.layers.size() > 1 ? " " + std::to_string(i) : "";
        const int layer = static_cast<int>(i);
        if (scene.light.illumination->method == model::IlluminationMethod::kPathTracing) {
            plan.passes.push_back({PassKind::kPixelPaths, "pixel paths" + suffix, "isosurface_pixel_paths", layer});
        } else {
            plan.passes.push_back({PassKind::kIllumination, "global light" + suffix, "isosurface_gather_light", layer});
        }
    }
}

}  // namespace radiata::plan
