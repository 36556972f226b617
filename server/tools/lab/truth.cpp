#include "tools/lab/truth.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "build/glyph_instances.h"
#include "reference/glyph_hits.h"
#include "store/glyph_dataset.h"

namespace radiata::lab {
namespace {

constexpr double kShift = 2e-4;     // radii that a decided first hit may move when its ray moves by 1e-5
constexpr double kTieRadii = 1e-5;  // two glyphs hit at the same place

/// As the renderer scales glyphs.
double millimetresPerAmplitude(const model::GlyphScale& scale, const store::GlyphDataset& dataset, float amplitude_max) {
    if (scale.mode == model::ScaleMode::kAbsolute) return static_cast<double>(scale.factor);
    const float largest = scale.mode == model::ScaleMode::kGlobal ? dataset.info().amplitude_typical : amplitude_max;
    return largest > 0 ? static_cast<float>(static_cast<double>(scale.factor) * halfVoxel(dataset.image()) /
                                            static_cast<double>(largest))
                       : 0;
}

}  // namespace

Truth::Truth(store::Store& store, const model::FrameRequest& request)
    : request_(request), forward_(model::cameraFrame(request.camera).forward) {
    for (const model::Layer& layer : request.scene.layers) {
        const auto dataset = store.glyphs(layer.glyphs().dataset_id);
        const model::ShImage& image = dataset->image();
        int limit = std::min(layer.glyphs().lmax.value_or(image.layout.lmax), image.layout.lmax);
        if (!image.layout.full) limit -= limit % 2;
        const ShLayout layout{limit, image.layout.full};
        const bool both = layer.glyphs().negative_lobes == model::NegativeLobes::kShown;
        const std::vector<std::uint32_t> slots = selectVoxels(image, layer.glyphs().selection);
        const std::vector<GlyphBounds> bounds = dataset->bounds(slots, limit, both);
        for (std::size_t i = 0; i < slots.size(); ++i) {
            const double scale = millimetresPerAmplitude(layer.glyphs().scale, *dataset, bounds[i].amplitude_max);
            const double radius = scale * static_cast<double>(bounds[i].radius);
            if (!(radius > 0)) continue;
            const float* first = image.coefficients.data() + slots[i] * image.layout.count();
            const glm::dvec3 centre(image.voxel_to_world * glm::dvec4(glm::dvec3(image.voxels[slots[i]]), 1.0));
            glyphs_.push_back({reference::ShFunction(layout, std::span(first, layout.count())), centre, scale, radius, both});
            largest_radius_ = std::max(largest_radius_, radius);
        }
    }
}

TrueHit Truth::at(int x, int y) const {
    const reference::Ray ray = reference::cameraRay(request_.camera, request_.width, request_.height, x + 0.5, y + 0.5);
    const double stretch = glm::dot(ray.direction, forward_);
    // Glyphs whose spheres the ray meets, by where it enters them; one that begins behind the nearest hit cannot matter.
    std::vector<std::pair<double, const Glyph*>> met;
    for (const Glyph& glyph : glyphs_) {
        const glm::dvec3 origin = ray.origin - glyph.centre;
        const double along = glm::dot(origin, ray.direction);
        const double off = glm::dot(origin, origin) - along * along;
        if (off > glyph.radius * glyph.radius * (1 + 1e-6)) continue;
        const double half = std::sqrt(std::max(0.0, glyph.radius * glyph.radius - off));
        if (request_.camera.perspective && half - along < 0) continue;
        met.emplace_back(-along - half, &glyph);
    }
    std::sort(met.begin(), met.end());
    TrueHit best;
    for (const auto& [entry, glyph] : met) {
        if (entry * stretch > best.depth_mm) break;
        consider(*glyph, ray, glm::dot(ray.origin - glyph->centre, ray.direction), stretch, best);
    }
    return best;
}

void Truth::consider(const Glyph& glyph, const reference::Ray& ray, double along, double stretch, TrueHit& best) const {
    // From the ray's point nearest to the centre, so that eyes far away cost no digits.
    const glm::dvec3 closest = (ray.origin - glyph.centre - along * ray.direction) / glyph.scale;
    const double t_min = request_.camera.perspective ? along / glyph.scale : -std::numeric_limits<double>::infinity();
    const reference::GlyphHits found = reference::glyphHits(glyph.f, closest, ray.direction, glyph.both_lobes, t_min);
    if (!(found.first_shift < kShift)) best.decided = false;
    if (found.hits.empty()) return;
    const double depth = (found.hits[0].t * glyph.scale - along) * stretch;
    if (best.hit && std::abs(depth - best.depth_mm) < kTieRadii * glyph.radius) best.decided = false;
    if (best.hit && depth >= best.depth_mm) return;
    best.hit = true;
    best.depth_mm = depth;
    best.radius_mm = glyph.radius;
    best.normal = glm::dot(found.hits[0].normal, ray.direction) > 0 ? -found.hits[0].normal : found.hits[0].normal;
}

}  // namespace radiata::lab
