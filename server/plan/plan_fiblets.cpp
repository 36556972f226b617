#include "plan/plan_fiblets.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "plan/plan.h"
#include "shaders/shared/fiblet.glsl"

namespace radiata::plan {
namespace {

/// Ends of a colour map that the request leaves open.
model::FibreColourRange fibreRange(const model::FibreColour& colour, const LayerFacts& facts) {
    if (colour.range) return *colour.range;
    const bool from_zero = colour.mode == model::FibreColourMode::kLength || colour.mode == model::FibreColourMode::kDistance;
    const float low = from_zero ? 0 : static_cast<float>(facts.value_min);
    const auto high = static_cast<float>(facts.value_max);
    if (low < high && std::isfinite(high - low)) return {low, high};
    return {low, low + std::max(1.0F, std::abs(low))};
}

/// The pipeline, or why not. \param tubes  some fibres are tubes
/// \param by_compute  it has other things that the rasteriser of lines does not draw; their name, or empty
model::FibletPipeline choosePipeline(model::FibletPipeline wanted, const Abilities& abilities, int line_width_px, bool tubes,
                                     const std::string& by_compute, const std::string& where) {
    using Pipeline = model::FibletPipeline;
    const auto failed = [&](Pipeline one) { return (abilities.failed_pipelines >> static_cast<unsigned>(one) & 1U) != 0; };
    if (wanted == Pipeline::kAuto) {
        const bool atomic = abilities.int64_atomics && !failed(Pipeline::kAtomic);
        wanted = atomic || !abilities.lines || failed(Pipeline::kPull) || tubes || !by_compute.empty() ? Pipeline::kAtomic
                                                                                                       : Pipeline::kPull;
    }
    const auto need = [&](bool has, const std::string& what) {
        if (!has) {
            throw Error(Code::kUnsupported, where + " is to be drawn by the fiblet pipeline " +
                                                std::string(model::pipelineName(wanted)) + ", which needs " + what +
                                                "; this device lacks it");
        }
    };
    const auto checkTested = [&] {
        if (!failed(wanted)) return;
        throw Error(Code::kUnsupported, where + " is to be drawn by the fiblet pipeline " +
                                            std::string(model::pipelineName(wanted)) +
                                            ", whose self-test shows a wrong picture on this device");
    };
    if (!by_compute.empty() && wanted != Pipeline::kAtomic) {
        throw Error(Code::kUnsupported, where + " has " + by_compute + ", which the fiblet pipeline atomic alone draws, not " +
                                            std::string(model::pipelineName(wanted)));
    }
    const bool by_atomics = wanted == Pipeline::kAtomic || wanted == Pipeline::kPoints;
    need(abilities.int64_atomics || !(by_atomics || tubes), std::string(by_atomics ? "" : "for tubes ") + "64-bit atomics");
    if (!model::drawsByRasteriser(wanted)) {
        checkTested();
        return wanted;
    }
    need(abilities.lines, "a rasteriser of lines");
    need(static_cast<float>(line_width_px) <= abilities.line_width_max,
         "lines of " + std::to_string(line_width_px) + " pixels; at most " +
             std::to_string(static_cast<int>(abilities.line_width_max)) + " are drawn");
    const bool mesh = wanted == Pipeline::kMesh || wanted == Pipeline::kMeshSerial;
    need(abilities.mesh_shader || !mesh, "task and mesh shaders");
    need(abilities.geometry_shader || wanted != Pipeline::kGeometry, "geometry shaders");
    need(abilities.tessellation_shader || wanted != Pipeline::kTessellation, "tessellation shaders");
    checkTested();
    return wanted;
}

/// \throws Error(kUnsupported) for what needs all fiblets at once
void checkPaged(const FibletPlan& fiblets, const model::Quality& quality, const std::string& where) {
    const std::string what = fiblets.pipeline != model::FibletPipeline::kAtomic
                                 ? "by the fiblet pipeline " + std::string(model::pipelineName(fiblets.pipeline))
                             : fiblets.culling == model::FibletCulling::kNone     ? "without culling"
                             : fiblets.culling == model::FibletCulling::kCoverage ? "with culling by coverage"
                             : quality.frozen_culling                             ? "with frozen culling"
                                                                                  : "";
    if (what.empty()) return;
    throw Error(Code::kUnsupported, where + " is to be drawn " + what +
                                        ", which needs all of it on the device; it takes more than the server's memory for a "
                                        "tractogram (--tract-memory)");
}

/// Segments per pixel from which it pays to look for fiblets that others hide, and the pixels up to which it costs next to
/// nothing: below, and above, pyramids of depths take longer than what they spare. What is seen is the same. Measured on
/// lavapipe (docs/architecture.md, "Fibres").
constexpr double kHidingSegments = 20;
constexpr double kHidingPixels = 300'000;

/// Whether looking for what is hidden pays for a layer.
bool hidingPays(const LayerFacts& facts, const model::FrameRequest& request) {
    if (request.quality.frozen_culling || request.quality.fiblet_pipeline != model::FibletPipeline::kAtomic || facts.paged) {
        return true;
    }
    const double segments = static_cast<double>(facts.fiblets) * shader::FIBLET_SEGMENTS;
    const double pixels = static_cast<double>(request.width) * static_cast<double>(request.height);
    return pixels <= kHidingPixels || segments >= kHidingSegments * pixels;
}

/// The module that draws.
std::string fibletShader(model::FibletPipeline pipeline) {
    switch (pipeline) {
        case model::FibletPipeline::kPoints:
            return "fiblet_points";
        case model::FibletPipeline::kMesh:
        case model::FibletPipeline::kMeshSerial:
            return "fiblet_line_of_mesh";
        case model::FibletPipeline::kAuto:
        case model::FibletPipeline::kAtomic:
            return "fiblet_raster";
        default:
            return "fiblet_line";
    }
}

}  // namespace

void planFiblets(std::size_t index, const LayerFacts& facts, const Abilities& abilities, FramePlan& plan) {
    model::TractogramLayer& layer = plan.resolved.scene.layers[index].tracts();
    if (layer.colour.usesMap()) layer.colour.range = fibreRange(layer.colour, facts);
    plan.fibre_colours |= 1U << static_cast<std::uint32_t>(layer.colour.mode);
    plan.fibre_occlusion = plan.fibre_occlusion || layer.occlusion_px.has_value();
    plan.fibre_halos = plan.fibre_halos || layer.halo_px.has_value();
    FibletPlan fiblets;
    model::Quality& quality = plan.resolved.quality;
    const bool transparent = plan.resolved.scene.layers[index].opacity < 1;
    const bool by_depths = std::ranges::any_of(layer.region_cuts, &model::FibreRegionCut::by_depths);
    quality.fiblet_pipeline =
        choosePipeline(quality.fiblet_pipeline, abilities, layer.line_width_px, layer.tube_radius_mm.has_value(),
                       layer.exact_width ? "exact_width"
                       : transparent     ? "an opacity below 1"
                       : by_depths       ? "a cut by depths"
                                         : "",
                       "scene.layers[" + std::to_string(index) + "].tractogram");
    if (model::drawsUncompressed(quality.fiblet_pipeline)) quality.fiblet_culling = model::FibletCulling::kNone;
    fiblets.pipeline = quality.fiblet_pipeline;
    fiblets.mesh_subgroups = abilities.mesh_subgroups;
    fiblets.culling = quality.fiblet_culling;
    fiblets.tubes = layer.tube_radius_mm.has_value();
    fiblets.selected_only = fiblets.tubes && layer.selected.has_value();
    fiblets.lines = !fiblets.tubes || fiblets.selected_only;
    fiblets.states = layer.selected.has_value() || !layer.shown.isAll() || !layer.criteria.empty();
    fiblets.segments = facts.segments_filtered;
    fiblets.exact_width = layer.exact_width && fiblets.lines;
    fiblets.mesh_cut = by_depths;
    fiblets.mesh_outside = std::ranges::any_of(layer.region_cuts, [](const auto& cut) { return cut.by_depths && cut.outside; });
    fiblets.dimmed = layer.selected.has_value() && layer.unselected == model::UnselectedFibres::kDimmed;
    fiblets.cuts = static_cast<std::uint32_t>(layer.cuts.size());
    fiblets.line_width_px = layer.line_width_px;
    fiblets.tube_radius_mm = layer.tube_radius_mm.value_or(0);
    fiblets.detail_px = quality.fiblet_detail_px.value_or(0);
    fiblets.paged = facts.paged;
    if (fiblets.paged) {
        plan.paged_layers |= 1U << index;
        checkPaged(fiblets, quality, "scene.layers[" + std::to_string(index) + "].tractogram");
    }
    plan.fiblets[index] = fiblets;
    // Peeled with the scene's other transparent layers.
    if (transparent) return;
    const std::string suffix = plan.fiblets.size() > 1 ? " " + std::to_string(index) : "";
    plan.passes.push_back(
        {PassKind::kFiblets, "fiblet raster" + suffix, fibletShader(fiblets.pipeline), static_cast<int>(index)});
}

void resolveCulling(const std::vector<LayerFacts>& layers, FramePlan& plan) {
    using Culling = model::FibletCulling;
    Culling& culling = plan.resolved.quality.fiblet_culling;
    const auto hides = [&](std::size_t i) { return plan.fiblets[i] && plan.resolved.scene.layers[i].opacity >= 1; };
    bool fibres = false, pays = false;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        fibres = fibres || plan.fiblets[i];
        pays = pays || (hides(i) && hidingPays(layers[i], plan.resolved));
    }
    if (fibres && culling == Culling::kAuto) culling = pays ? Culling::kTwoPhase : Culling::kFrustum;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (!plan.fiblets[i]) continue;
        plan.fiblets[i]->culling = culling == Culling::kTwoPhase && !hides(i) ? Culling::kFrustum : culling;
    }
}

}  // namespace radiata::plan
