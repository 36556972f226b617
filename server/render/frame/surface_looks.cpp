#include "render/frame/surface_looks.h"

#include <algorithm>
#include <limits>

#include "gpu/device.h"
#include "render/frame/isosurface_passes.h"
#include "shaders/shared/surface_look.glsl"
#include "store/volume_dataset.h"

namespace radiata::render {
namespace {

/// Fog from the nearest corner of the layer's box to the farthest, along the line of sight.
void addFog(const DrawList& list, const DrawnLayer& layer, float share, shader::SurfaceLook& look) {
    const glm::dvec3 forward(list.camera.rays.forward);
    double near = std::numeric_limits<double>::infinity(), far = -near;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 place =
            glm::mix(layer.bounds.minimum, layer.bounds.maximum, glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2));
        const double along = glm::dot(place - list.camera.reference_mm, forward);
        near = std::min(near, along);
        far = std::max(far, along);
    }
    look.fog = share;
    look.fog_begin = static_cast<float>(near);
    look.fog_per_mm = static_cast<float>(1 / std::max(far - near, 1e-6));
}

}  // namespace

void fillSurfaceLooks(gpu::Device& device, Target::Impl& target, const DrawList& list) {
    if (list.plan->surface_looks == 0) return;
    ensureBytes(device, target.surface_looks, 8 * sizeof(shader::SurfaceLook), gpu::Memory::kUpload, "looks of isosurfaces");
    for (std::size_t i = 0; i < list.layers.size(); ++i) {
        const model::IsosurfaceLayer* surface = list.plan->resolved.scene.layers[i].ifSurface();
        if (surface == nullptr) continue;
        shader::SurfaceLook look{};
        look.shading = static_cast<std::uint32_t>(surface->shading);
        if (surface->fog) addFog(list, list.layers[i], *surface->fog, look);
        if (const store::VolumeDataset* colours = list.layers[i].colours.get()) {
            look.values = colours->params();
            placeInGrid(*colours, list.camera.reference_mm, look.base, look.fraction);
        }
        target.surface_looks.as<shader::SurfaceLook>()[i] = look;
    }
}

std::uint64_t surfaceLooksAddress(const Target::Impl& target, const plan::FramePlan& plan) {
    return plan.surface_looks != 0 ? target.surface_looks.address() : 0;
}

}  // namespace radiata::render
