#include "render/frame/pick.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "gpu/device.h"
#include "math/sh_evaluate.h"
#include "render/fiblet/fibre_measures.h"
#include "store/volume_dataset.h"

namespace radiata::render {
namespace {

constexpr std::uint32_t kNobody = 0xffffffffU;

/// The surface's point in world space.
glm::dvec3 hitPosition(const DrawList& list, const shader::Surface& surface, const glm::ivec2& away = glm::ivec2(0)) {
    return pickRay(list, away).at(static_cast<double>(surface.depth));
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

/// \param away  pixels from the middle of the window
model::PickedFibre describeFibre(const DrawList& list, const shader::Surface& surface, const glm::ivec2& away) {
    const std::size_t layer = surface.layer_and_steps >> 24U;
    const model::FibletSet& set = list.layers[layer].tracts->set();
    const std::uint32_t fiblet = surface.who >> shader::FIBLET_SEGMENT_BITS;
    const std::uint32_t segment = surface.who & ((1U << shader::FIBLET_SEGMENT_BITS) - 1);
    const model::FibletHead& head = set.heads[fiblet];
    model::PickedFibre fibre;
    fibre.layer = static_cast<int>(layer);
    fibre.dataset_id = list.plan->resolved.scene.layers[layer].datasetId();
    fibre.fibre = head.fibre;
    fibre.point = shader::FIBLET_SEGMENTS * model::fibletIndex(head) + segment;
    const FibreSegmentPlace ends = segmentPlace(set, fiblet, segment);
    const glm::dvec3 along = ends.to - ends.from;
    // The point of the segment that is nearest to the pixel's ray where that meets it.
    const glm::dvec3 seen = hitPosition(list, surface, away) - ends.from;
    const double length2 = glm::dot(along, along);
    fibre.position_mm = ends.from + (length2 > 0 ? std::clamp(glm::dot(seen, along) / length2, 0.0, 1.0) : 0.0) * along;
    fibre.tangent = length2 > 0 ? glm::normalize(along) : along;
    fibre.length_mm = fibreLength(set, head.fibre);
    fibre.distance_px = glm::length(glm::dvec2(away));
    for (const model::FibreGroup& group : set.groups) {
        if (std::ranges::binary_search(group.fibres, head.fibre)) fibre.groups.push_back(group.name);
    }
    for (const model::FibreColumn& column : set.fibre_columns) {
        const auto first = column.values.begin() + static_cast<std::ptrdiff_t>(std::size_t{head.fibre} * column.components);
        fibre.values.push_back({column.name, {first, first + column.components}});
    }
    return fibre;
}

model::PickedSurface describeSurface(const DrawList& list, const shader::Surface& surface) {
    model::PickedSurface picked;
    const std::size_t layer = surface.layer_and_steps >> 24U;
    const store::VolumeDataset& volume = *list.layers[layer].volume;
    picked.layer = static_cast<int>(layer);
    const model::IsosurfaceLayer& wanted = list.plan->resolved.scene.layers[layer].surface();
    picked.dataset_id = wanted.dataset_id;
    picked.position_mm = hitPosition(list, surface, {0, 0});
    const glm::ivec3 nearest(glm::round(volume.worldToGrid(picked.position_mm)));
    picked.voxel = glm::clamp(nearest, glm::ivec3(0), volume.params().size - 1);
    picked.normal = glm::dvec3(surface.normal);
    picked.value = *wanted.isovalue;
    return picked;
}

}  // namespace

model::FrameRequest pickRequest(const model::FrameRequest& request, int x, int y, int radius_px,
                                const plan::Abilities& abilities) {
    if (radius_px < 0 || radius_px > model::kPickRadiusMax) {
        throw Error(Code::kInvalidArgument, "the radius of a pick is " + std::to_string(radius_px) +
                                                " pixels; it must be 0 to " + std::to_string(model::kPickRadiusMax));
    }
    if (x < 0 || y < 0 || x >= request.width || y >= request.height) {
        throw Error(Code::kInvalidArgument, "pixel " + std::to_string(x) + ", " + std::to_string(y) +
                                                " lies outside the picture of " + std::to_string(request.width) + " x " +
                                                std::to_string(request.height) + " pixels, which count from 0");
    }
    if (!abilities.bvh && !abilities.ray_query) {
        throw Error(Code::kUnsupported, "picks need ray queries or a hierarchy; neither passed this device's self-test");
    }
    if (request.quality.frozen_culling) {
        throw Error(Code::kUnsupported, "picks do not know which fibres quality.frozen_culling leaves out; draw without it");
    }
    model::FrameRequest pixel = request;
    pixel.quality = {};
    pixel.quality.samples = 1;
    pixel.quality.fiblet_pipeline = request.quality.fiblet_pipeline;
    pixel.quality.fiblet_detail_px = request.quality.fiblet_detail_px;
    pixel.quality.traversal = abilities.bvh ? model::Traversal::kBvh : model::Traversal::kRayQuery;
    pixel.quality.pole_table = model::PoleTable::kOff;
    pixel.scene.light = {};
    for (model::Layer& layer : pixel.scene.layers) {
        if (layer.ifGlyphs()) layer.glyphs().colour = {};
        if (layer.ifTracts()) layer.tracts().colour = {};
        if (!layer.ifSurface()) layer.opacity = 1;  // transparent fibres and glyphs are picked as others are
        if (model::IsosurfaceLayer* surface = std::get_if<model::IsosurfaceLayer>(&layer.content)) {
            *surface = {.dataset_id = surface->dataset_id, .isovalue = surface->isovalue};
        }
    }
    // Of a window that small, the frustum leaves out nearly everything.
    pixel.quality.fiblet_culling = model::FibletCulling::kFrustum;
    return pixel;
}

bool makeSurfacesOpaque(model::FrameRequest& request) {
    bool changed = false;
    for (model::Layer& layer : request.scene.layers) {
        if (!layer.ifSurface() || layer.opacity >= 1) continue;
        layer.opacity = 1;
        changed = true;
    }
    return changed;
}

std::optional<model::Picked> pickPixel(gpu::Device& device, Drawer& drawer, Target::Impl& target, DrawList& list, int x, int y,
                                       int radius_px, const FoundGlyph& found_glyph) {
    const model::FrameRequest& picture = list.plan->resolved;
    const bool fibres = std::ranges::any_of(list.layers, [](const DrawnLayer& layer) { return layer.tracts != nullptr; });
    const int radius = fibres ? radius_px : 0, size = 2 * radius + 1;
    list.pixel_offset = {static_cast<float>(x + 0.5 - 0.5 * picture.width), static_cast<float>(y + 0.5 - 0.5 * picture.height)};
    target.prepare(device, size, size, list.layers.size());
    list.all_pages = true;
    drawer.drawSample(target, list, 0, nullptr);
    drawer.takeTimings();
    std::vector<shader::Surface> surfaces(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    gpu::download(device, target.surface, 0, std::as_writable_bytes(std::span(surfaces)));
    const auto layerOf = [&](const shader::Surface& surface) -> const DrawnLayer& {
        return list.layers[surface.layer_and_steps >> 24U];
    };
    const auto at = [&](int dx, int dy) -> const shader::Surface& {
        return surfaces[static_cast<std::size_t>((dy + radius) * size + dx + radius)];
    };
    const shader::Surface& middle = at(0, 0);
    if (middle.who != kNobody && layerOf(middle).glyphs) {
        model::PickedGlyph glyph = describeGlyph(list, middle);
        if (found_glyph) found_glyph(layerOf(middle).glyphs->instances()[middle.who], glyph);
        return glyph;
    }
    if (middle.who != kNobody && layerOf(middle).volume) return describeSurface(list, middle);
    glm::ivec2 best(0);
    bool found = false;
    const auto nearness = [&](const glm::ivec2& d) { return std::pair(d.x * d.x + d.y * d.y, at(d.x, d.y).depth); };
    for (int dy = -radius; dy <= radius; ++dy) {
        for (int dx = -radius; dx <= radius; ++dx) {
            const shader::Surface& surface = at(dx, dy);
            const bool inside = x + dx >= 0 && y + dy >= 0 && x + dx < picture.width && y + dy < picture.height;
            if (!inside || surface.who == kNobody || !layerOf(surface).tracts || dx * dx + dy * dy > radius * radius) continue;
            if (found && nearness({dx, dy}) >= nearness(best)) continue;
            best = {dx, dy};
            found = true;
        }
    }
    if (!found) return std::nullopt;
    return describeFibre(list, at(best.x, best.y), best);
}

}  // namespace radiata::render
