#include "render/frame/pick_hits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "gpu/device.h"
#include "plan/method_plan.h"
#include "shaders/shared/glyph_rays.glsl"

namespace radiata::render {
namespace {

constexpr std::uint32_t kHitsMax =
    2 * (2 * kLmaxLimit + 2);  ///< of any method and bands; see shaders/common/circle_all_hits.glsl
/// From the centre, in glyph radii: rays begin there at the earliest, so that their start does not cost precision.
constexpr double kStartRadii = 100;

struct Push {
    std::uint64_t rays, answers, glyph;
    std::uint32_t count;
};

gpu::Buffer uploaded(gpu::Device& device, std::span<const std::byte> bytes, const std::string& name) {
    gpu::Buffer buffer(device, bytes.size(), gpu::Memory::kDevice, name);
    gpu::upload(device, buffer, 0, bytes);
    return buffer;
}

/// The module's layout: for the march the smallest of those that are compiled which holds the glyph's bands.
std::string layoutName(const plan::GlyphPlan& plan) {
    if (!plan.method_module.empty()) return plan.layout_name;
    const std::string parity = plan.layout_name.substr(0, 4);
    const int k = std::stoi(plan.layout_name.substr(4));
    if (k <= 4) return parity + "4";
    return parity + (parity == "even" && k <= 8 ? "8" : "16");
}

/// Coefficients of the module's layout, whose further bands are zero, and the certified radius.
std::vector<float> glyphValues(const model::PickedGlyph& glyph, const std::string& layout_name, double radius) {
    const ShLayout layout{std::stoi(layout_name.substr(4)), layout_name.starts_with("full")};
    std::vector<float> values = glyph.coefficients;
    values.resize(layout.count(), 0.0F);
    values.push_back(static_cast<float>(radius));
    return values;
}

std::vector<model::RayHit> allHits(gpu::Device& device, Drawer& drawer, const DrawList& list,
                                   const shader::GlyphInstance& instance, const model::PickedGlyph& glyph,
                                   const model::Quality& quality, const plan::Abilities& abilities) {
    const model::FrameRequest& picture = list.plan->resolved;
    const auto layer = static_cast<std::size_t>(glyph.layer);
    const model::GlyphLayer& settings = picture.scene.layers[layer].glyphs();
    const std::string where = "scene.layers[" + std::to_string(layer) + "].glyphs";
    if (settings.tensor == model::TensorShape::kEllipsoid) {
        throw Error(Code::kInvalidArgument, where +
                                                " draws ellipsoids, which are met at a ray's first hit only; all hits are "
                                                "found of Reynolds glyphs and of spherical harmonics");
    }
    const store::GlyphDataset& dataset = list.layers[layer].glyphs->dataset();
    plan::LayerFacts facts;
    facts.layout = dataset.image().layout;
    facts.odd_bands_only = dataset.oddBandsOnly();
    const plan::GlyphPlan method = plan::planMethod(quality, settings, facts, abilities, where);
    const std::string layout_name = layoutName(method);

    // From the point nearest to the centre, so that float32 tells hits apart wherever the camera is.
    const PickRay world = pickRay(list);
    const auto scale = static_cast<double>(instance.scale), radius = static_cast<double>(instance.radius) / scale;
    const double foot = glm::dot(glyph.centre_mm - world.origin_mm, world.direction);
    const double first = std::max((world.near - foot) / scale, -kStartRadii * radius);
    const shader::GlyphRay ray{glm::vec3((world.at(foot) - glyph.centre_mm) / scale), static_cast<float>(first),
                               glm::vec3(world.direction), method.both_lobes ? 1U : 0U};
    const std::vector<float> values = glyphValues(glyph, layout_name, radius);
    std::vector<float> answer(shader::GLYPH_RAY_HEADER + shader::GLYPH_RAY_WORDS * kHitsMax);
    const gpu::Buffer ray_buffer = uploaded(device, std::as_bytes(std::span(&ray, 1)), "ray of a pick");
    const gpu::Buffer glyph_buffer = uploaded(device, std::as_bytes(std::span(values)), "glyph of a pick");
    const gpu::Buffer answer_buffer(device, answer.size() * sizeof(float), gpu::Memory::kDevice, "hits of a pick");
    std::vector<std::uint32_t> constants{PassRun::kGroup};
    constants.insert(constants.end(), method.method_constants.begin(), method.method_constants.end());
    drawer.recorder().dispatch(drawer.pipelines().get("glyph_all_hits_" + method.method_module + layout_name, constants),
                               "all hits", 1, 1, 1,
                               Push{ray_buffer.address(), answer_buffer.address(), glyph_buffer.address(), 1});
    drawer.recorder().submitAndWait();
    drawer.takeTimings();
    gpu::download(device, answer_buffer, 0, std::as_writable_bytes(std::span(answer)));
    if (answer[1] != 0) throw Error(Code::kInternal, "the march gave up on the ray of this pick; its hits are not known");

    std::vector<model::RayHit> hits;
    const auto count = static_cast<std::size_t>(answer[0]);
    for (std::size_t i = 0; i < count; ++i) {
        const float* word = &answer[shader::GLYPH_RAY_HEADER + shader::GLYPH_RAY_WORDS * i];
        const double t = foot + static_cast<double>(word[0]) * scale;
        if (t > world.far) continue;
        model::RayHit hit;
        hit.position_mm = world.at(t);
        // Rays of orthographic cameras all have the direction of the line of sight.
        hit.distance_mm = glm::dot(hit.position_mm - picture.camera.eye_mm, world.direction);
        const glm::dvec3 offset = hit.position_mm - glyph.centre_mm;
        hit.radius_mm = glm::length(offset);
        hit.direction = offset / hit.radius_mm;
        hit.negative_lobe = word[1] < 0;
        hit.leaving = word[2] == 0;
        hits.push_back(hit);
    }
    return hits;
}

}  // namespace

PickRay pickRay(const DrawList& list, const glm::ivec2& away) {
    const shader::CameraRays& rays = list.camera.rays;
    const glm::dvec2 offset = glm::dvec2(list.pixel_offset) + glm::dvec2(away);
    const glm::dvec3 origin = offset.x * glm::dvec3(rays.step_right) - offset.y * glm::dvec3(rays.step_up);
    const glm::dvec3 direction = origin * static_cast<double>(rays.inverse_distance) + glm::dvec3(rays.forward);
    const double stretch = glm::length(direction);
    return {list.camera.reference_mm + origin, direction / stretch, static_cast<double>(rays.near_depth) * stretch,
            static_cast<double>(rays.far_depth) * stretch};
}

FoundGlyph allHitsFinder(gpu::Device& device, Drawer& drawer, const DrawList& list, const model::Quality& quality,
                         const plan::Abilities& abilities) {
    return [&](const shader::GlyphInstance& instance, model::PickedGlyph& glyph) {
        glyph.hits = allHits(device, drawer, list, instance, glyph, quality, abilities);
    };
}

}  // namespace radiata::render
