#include "plan/plan_isosurface.h"

#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "plan/value_range.h"
#include "shaders/shared/surface_look.glsl"

namespace radiata::plan {
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

}  // namespace

bool isVeil(const model::Layer& layer) { return layer.ifSurface() && layer.opacity < 1; }

void planIsosurface(FramePlan& plan, std::size_t index, const LayerFacts& facts, const Abilities& abilities) {
    model::Layer& layer = plan.resolved.scene.layers[index];
    model::IsosurfaceLayer& surface = layer.surface();
    if (facts.value_min == facts.value_max) {
        throw Error(Code::kInvalidArgument, "scene.layers[" + std::to_string(index) + "].isosurface: '" + surface.dataset_id +
                                                "' has the value " + number(facts.value_min) +
                                                " everywhere; a surface lies between different values");
    }
    const float isovalue = surface.isovalue.value_or(static_cast<float>(facts.value_split));
    if (!(isovalue >= facts.value_min && isovalue <= facts.value_max)) {
        throw Error(Code::kInvalidArgument, "scene.layers[" + std::to_string(index) + "].isosurface.isovalue is " +
                                                number(isovalue) + "; '" + surface.dataset_id + "' has values from " +
                                                number(facts.value_min) + " to " + number(facts.value_max));
    }
    surface.isovalue = isovalue;
    plan.colour_modes |= 1U << static_cast<std::uint32_t>(model::ColourMode::kUniform);
    if (surface.shading != model::SurfaceShading::kScene) plan.surface_looks |= shader::SURFACE_LOOKS_SHADING;
    if (surface.fog) plan.surface_looks |= shader::SURFACE_LOOKS_FOG;
    if (surface.colour_by) {
        plan.surface_looks |= shader::SURFACE_LOOKS_VOLUME;
        if (!surface.colour_by->range) surface.colour_by->range = valueRange(facts.colours.low, facts.colours.high);
    }
    if (isVeil(layer)) return;
    const std::string suffix = plan.resolved.scene.layers.size() > 1 ? " " + std::to_string(index) : "";
    if (plan.resolved.quality.isosurface.method == model::SurfaceMethod::kMarchingCubes) {
        if (!abilities.raster) {
            throw Error(
                Code::kUnsupported,
                "quality.isosurface.method is marching-cubes, but this device draws no triangles or failed the start-up "
                "self-test of drawing; use exact");
        }
        plan.passes.push_back(
            {PassKind::kIsosurfaceMesh, "isosurface mesh" + suffix, "isosurface_mesh", static_cast<int>(index)});
        plan.passes.push_back(
            {PassKind::kRasterSurface, "isosurface surface" + suffix, "raster_surface", static_cast<int>(index)});
        return;
    }
    plan.passes.push_back(
        {PassKind::kIsosurfaceTrace, "isosurface trace" + suffix, "isosurface_trace", static_cast<int>(index)});
}

}  // namespace radiata::plan
