#include "render/frame/pick.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "gpu/device.h"
#include "math/sh_evaluate.h"
#include "store/volume_dataset.h"

namespace radiata::render {
namespace {

/// The surface's point in world space, in double, from the ray that the device used.
glm::dvec3 hitPosition(const DrawList& list, const shader::Surface& surface) {
    const shader::CameraRays& rays = list.camera.rays;
    const glm::dvec2 offset(list.pixel_offset);
    const glm::dvec3 origin = offset.x * glm::dvec3(rays.step_right) - offset.y * glm::dvec3(rays.step_up);
    const glm::dvec3 direction = origin * static_cast<double>(rays.inverse_distance) + glm::dvec3(rays.forward);
    return list.camera.reference_mm + origin + static_cast<double>(surface.depth) * glm::normalize(direction);
}

model::PickedGlyph describeGlyph(const DrawList& list, const shader::Surface& surface) {
    model::PickedGlyph glyph;
    const std::size_t layer = surface.layer_and_steps >> 24U;
    const GlyphScene& scene = *list.layers[layer].glyphs;
    const model::ShImage& image = scene.dataset().image();
    const shader::GlyphInstance& instance = scene.instances()[surface.who];
    glyph.layer = static_cast<int>(layer);
    glyph.dataset_id = scene.layer().dataset_id;
    glyph.voxel = image.voxels[instance.slot];
    glyph.centre_mm = glm::dvec3(image.voxel_to_world * glm::dvec4(glm::dvec3(glyph.voxel), 1.0));
    // Both kinds of layout order bands alike, so the drawn bands are a prefix.
    const int lmax = list.plan->resolved.scene.layers[layer].glyphs().lmax.value_or(image.layout.lmax);
    glyph.layout = {image.layout.full ? lmax : lmax - lmax % 2, image.layout.full};
    const auto first = image.coefficients.begin() + static_cast<std::ptrdiff_t>(instance.slot * image.layout.count());
    glyph.coefficients.assign(first, first + static_cast<std::ptrdiff_t>(glyph.layout.count()));
    const glm::dvec3 offset = hitPosition(list, surface) - glyph.centre_mm;
    glyph.direction = glm::normalize(offset);
    glyph.amplitude = evaluateSh(glyph.layout, std::span<const float>(glyph.coefficients), glyph.direction);
    // An ellipsoid is not the graph of its tensor's function.
    const bool ellipsoid = scene.layer().tensor == model::TensorShape::kEllipsoid;
    glyph.radius_mm = ellipsoid ? glm::length(offset) : std::abs(glyph.amplitude) * static_cast<double>(instance.scale);
    glyph.position_mm = glyph.centre_mm + glyph.radius_mm * glyph.direction;
    return glyph;
}

model::PickedSurface describeSurface(const DrawList& list, const shader::Surface& surface) {
    model::PickedSurface picked;
    const std::size_t layer = surface.layer_and_steps >> 24U;
    const store::VolumeDataset& volume = *list.layers[layer].volume;
    picked.layer = static_cast<int>(layer);
    const model::IsosurfaceLayer& wanted = list.plan->resolved.scene.layers[layer].surface();
    picked.dataset_id = wanted.dataset_id;
    picked.position_mm = hitPosition(list, surface);
    const glm::ivec3 nearest(glm::round(volume.worldToGrid(picked.position_mm)));
    picked.voxel = glm::clamp(nearest, glm::ivec3(0), volume.params().size - 1);
    picked.normal = glm::dvec3(surface.normal);
    picked.value = *wanted.isovalue;
    return picked;
}

}  // namespace

model::FrameRequest pickRequest(const model::FrameRequest& request, int x, int y, const plan::Abilities& abilities) {
    if (x < 0 || y < 0 || x >= request.width || y >= request.height) {
        throw Error(Code::kInvalidArgument, "pixel " + std::to_string(x) + ", " + std::to_string(y) +
                                                " lies outside the picture of " + std::to_string(request.width) + " x " +
                                                std::to_string(request.height) + " pixels, which count from 0");
    }
    if (!abilities.bvh && !abilities.ray_query) {
        throw Error(Code::kUnsupported, "picks need ray queries or a hierarchy; neither passed this device's self-test");
    }
    model::FrameRequest pixel = request;
    pixel.quality = {};
    pixel.quality.samples = 1;
    pixel.quality.traversal = abilities.bvh ? model::Traversal::kBvh : model::Traversal::kRayQuery;
    pixel.quality.pole_table = model::PoleTable::kOff;
    pixel.scene.light = {};
    for (model::Layer& layer : pixel.scene.layers) {
        if (layer.ifGlyphs()) layer.glyphs().colour = {};
    }
    return pixel;
}

std::optional<model::Picked> pickPixel(gpu::Device& device, Drawer& drawer, Target::Impl& target, DrawList& list, int x,
                                       int y) {
    const model::FrameRequest& picture = list.plan->resolved;
    list.pixel_offset = {static_cast<float>(x + 0.5 - 0.5 * picture.width), static_cast<float>(y + 0.5 - 0.5 * picture.height)};
    target.prepare(device, 1, 1, list.layers.size());
    drawer.drawSample(target, list, 0, nullptr);
    drawer.takeTimings();
    shader::Surface surface{};
    gpu::download(device, target.surface, 0, std::as_writable_bytes(std::span(&surface, 1)));
    if (surface.who == 0xffffffffU) return std::nullopt;
    if (list.layers[surface.layer_and_steps >> 24U].volume) return describeSurface(list, surface);
    return describeGlyph(list, surface);
}

}  // namespace radiata::render
