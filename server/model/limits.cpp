#include "model/limits.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>

#include "base/error.h"
#include "math/sh_layout.h"
#include "model/selection_text.h"

namespace radiata::model {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(Code::kInvalidArgument, message); }

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Small numbers as they are: a step of 1e-9 is not "0.000000".
template <typename Number>
std::string text(Number value) {
    std::ostringstream out;
    if constexpr (std::is_floating_point_v<Number>) {
        out << std::setprecision(std::numeric_limits<Number>::digits10) << value;
    } else {
        out << +value;
    }
    return out.str();
}

std::string text(const glm::dvec3& v) {
    std::ostringstream out;
    out << "(" << v.x << ", " << v.y << ", " << v.z << ")";
    return out.str();
}

void checkDirection(const glm::dvec3& direction, const std::string& field) {
    const double length = glm::length(direction);
    if (!(length > 0) || !std::isfinite(length)) refuse(field + " is " + text(direction) + "; it must be finite and not zero");
}

/// \param colour  linear RGB
void checkRgb(const glm::dvec3& colour, const std::string& field) {
    for (int c = 0; c < 3; ++c) {
        if (!(colour[c] >= 0 && colour[c] <= 1)) refuse(field + " is " + text(colour) + "; each channel must be 0 to 1");
    }
}

void checkSelection(const VoxelSelection& selection, const std::string& where) {
    if (selection.region == Region::kVolume) return;
    if (selection.position_mm && !finite(*selection.position_mm)) {
        refuse(where + ".position_mm is " + text(*selection.position_mm) + "; it must be finite");
    }
    if (selection.plane == Plane::kOblique) checkDirection(selection.normal, where + ".normal");
    if (selection.region == Region::kSlab && !(selection.thickness_mm > 0 && std::isfinite(selection.thickness_mm))) {
        refuse(where + ".thickness_mm is " + text(selection.thickness_mm) + "; it must be finite and above 0");
    }
}

void checkRange(const ColourRange& range, const std::string& where) {
    const auto [low, high] = range;
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high) || !std::isfinite(high - low)) {
        refuse(where + ": the range of the colour map is " + text(low) + " to " + text(high) +
               "; both must be finite and the second above the first");
    }
}

void checkColour(const GlyphColour& colour, const std::string& where) {
    if (colour.mode == ColourMode::kScalar && colour.image_id.empty()) {
        refuse(where + ".scalar.image_id is empty; it names a scalar volume of the catalogue");
    }
    if (colour.usesMap() && colour.range) checkRange(*colour.range, where);
    if (colour.mode == ColourMode::kUniform) checkRgb(glm::dvec3(colour.uniform), where + ".uniform");
}

void checkUncertainty(const Uncertainty& uncertainty, const std::string& where) {
    if (uncertainty.dataset_id.empty()) refuse(where + ".dataset_id is empty; the catalogue lists the ids");
    if (!(uncertainty.deviations > 0 && uncertainty.deviations <= 100)) {
        refuse(where + ".deviations is " + text(uncertainty.deviations) + "; it must be above 0 and at most 100");
    }
    if (const auto extinction = uncertainty.extinction_per_mm; extinction && !(*extinction > 0 && *extinction <= 1e6F)) {
        refuse(where + ".extinction_per_mm is " + text(*extinction) + "; it must be above 0 and at most 1e6");
    }
    checkRgb(glm::dvec3(uncertainty.emission), where + ".emission");
}

void checkContent(const GlyphLayer& glyphs, const std::string& where) {
    checkSelection(glyphs.selection, where + ".selection");
    if (!(glyphs.scale.factor > 0 && glyphs.scale.factor <= 1e6F)) {
        refuse(where + ".scale.factor is " + text(glyphs.scale.factor) + "; it must be above 0 and at most 1e6");
    }
    if (glyphs.lmax && (*glyphs.lmax < 0 || *glyphs.lmax > kLmaxLimit)) {
        refuse(where + ".lmax is " + text(*glyphs.lmax) + "; it must be 0 to 16");
    }
    checkColour(glyphs.colour, where + ".colour");
    if (glyphs.uncertainty) checkUncertainty(*glyphs.uncertainty, where + ".uncertainty");
    if (!(glyphs.isotropic_part >= 0 && glyphs.isotropic_part <= 10)) {
        refuse(where + ".isotropic_part is " + text(glyphs.isotropic_part) + "; it must be 0 to 10");
    }
    if (glyphs.isotropic_part > 0 && glyphs.tensor == TensorShape::kEllipsoid) {
        refuse(where + ".isotropic_part is of Reynolds glyphs and spherical harmonics; an ellipsoid has none");
    }
}

/// Reads a selection or region to see that it can be, so that a bad one is refused when a scene is set. Empty is fine.
void checkText(const std::string& text, std::string_view kind, const std::string& where) {
    if (text.empty() && kind == "selection") return;
    try {
        if (kind == "selection") {
            parseSelection(text);
        } else {
            parseRegion(text);
        }
    } catch (const Error& error) {
        refuse(where + ": " + error.what());
    }
}

void checkFibres(const FibreSet& fibres, const std::string& where) {
    for (const std::optional<float>& bound : {fibres.length_min_mm, fibres.length_max_mm}) {
        if (bound && !(*bound >= 0 && std::isfinite(*bound))) {
            refuse(where + ".length is " + text(*bound) + " mm; it must be 0 or more and finite");
        }
    }
    if (fibres.length_min_mm && fibres.length_max_mm && *fibres.length_min_mm > *fibres.length_max_mm) {
        refuse(where + ".length_min_mm is above length_max_mm: no fibre could be shown");
    }
}

void checkFilters(const TractogramLayer& tracts, const std::string& where) {
    if (std::max(tracts.region_cuts.size(), tracts.criteria.size()) > kFibreFiltersMax) {
        refuse(where + " has " + text(tracts.region_cuts.size()) + " region_cuts and " + text(tracts.criteria.size()) +
               " criteria; at most " + text(kFibreFiltersMax) + " of each are possible");
    }
    for (std::size_t i = 0; i < tracts.region_cuts.size(); ++i) {
        const FibreRegionCut& cut = tracts.region_cuts[i];
        const std::string at = where + ".region_cuts[" + text(i) + "]";
        checkText(cut.region, "region", at + ".region");
        if (cut.by_depths && parseRegion(cut.region).shape != RegionShape::kMesh) {
            refuse(at + " is by_depths, which are those of a mesh; its region is '" + cut.region +
                   "' instead of mesh(DATASET)");
        }
    }
    if (std::ranges::count_if(tracts.region_cuts, &FibreRegionCut::by_depths) > 1)
        refuse(where + " has several region_cuts by_depths; one is possible");
    for (std::size_t i = 0; i < tracts.criteria.size(); ++i) {
        const FibreCriterion& criterion = tracts.criteria[i];
        const std::string at = where + ".criteria[" + text(i) + "]";
        if (criterion.column.empty()) refuse(at + ".column is empty; the catalogue lists the columns");
        if (!(criterion.low <= criterion.high)) {
            refuse(at + " keeps values from " + text(criterion.low) + " to " + text(criterion.high) +
                   "; the first must be at most the second");
        }
    }
    checkText(tracts.shown.selection, "selection", where + ".shown.selection");
    if (tracts.selected) checkText(tracts.selected->selection, "selection", where + ".selected.selection");
    if (tracts.colour.mode == FibreColourMode::kDistance) {
        if (tracts.colour.region.empty())
            refuse(where + ".colour.distance.region is empty; it is one region, such as sphere(0, 0, 0, 5)");
        checkText(tracts.colour.region, "region", where + ".colour.distance.region");
    }
}

void checkContent(const TractogramLayer& tracts, const std::string& where) {
    checkFilters(tracts, where);
    if (tracts.line_width_px < 1 || tracts.line_width_px > kLineWidthMax) {
        refuse(where + ".line_width_px is " + text(tracts.line_width_px) + "; it must be 1 to " + text(kLineWidthMax));
    }
    if (tracts.tube_radius_mm && !(*tracts.tube_radius_mm > 0 && *tracts.tube_radius_mm <= kTubeRadiusMaxMm)) {
        refuse(where + ".tube_radius_mm is " + text(*tracts.tube_radius_mm) + "; it must be above 0 and at most 100");
    }
    if (tracts.occlusion_px && !(*tracts.occlusion_px > 0 && *tracts.occlusion_px <= kFibreOcclusionMaxPx)) {
        refuse(where + ".occlusion_px is " + text(*tracts.occlusion_px) + "; it must be above 0 and at most 128");
    }
    if (tracts.halo_px && !(*tracts.halo_px > 0 && *tracts.halo_px <= kHaloMaxPx)) {
        refuse(where + ".halo_px is " + text(*tracts.halo_px) + "; it must be above 0 and at most 8");
    }
    if (tracts.cuts.size() > kFibreCutsMax) {
        refuse(where + " has " + text(tracts.cuts.size()) + " cuts, a slab being two; at most 6 are possible");
    }
    for (std::size_t i = 0; i < tracts.cuts.size(); ++i) {
        const FibreCut& cut = tracts.cuts[i];
        const double length = glm::length(cut.normal);
        if (!(length > 0 && std::isfinite(length)) || !std::isfinite(glm::length(cut.point_mm))) {
            refuse(where + ".cuts[" + text(i) + "]: point and normal must be finite and the normal not zero");
        }
    }
    const FibreColour& colour = tracts.colour;
    const bool by_column = colour.mode == FibreColourMode::kColumn || colour.mode == FibreColourMode::kPointColumn;
    if (by_column && colour.column.empty()) {
        refuse(where + ".colour names an empty column; the catalogue lists the columns");
    }
    if (colour.range &&
        !(std::isfinite(colour.range->low) && std::isfinite(colour.range->high) && colour.range->low < colour.range->high)) {
        refuse(where + ".colour range is " + text(colour.range->low) + " to " + text(colour.range->high) +
               "; both must be finite, low below high");
    }
    for (int c = 0; c < 3; ++c) {
        if (!(colour.uniform[c] >= 0 && colour.uniform[c] <= 1)) {
            refuse(where + ".colour.uniform is outside 0 to 1 (linear RGB)");
        }
    }
    checkFibres(tracts.shown, where + ".shown");
    if (tracts.selected) checkFibres(*tracts.selected, where + ".selected");
}

void checkContent(const IsosurfaceLayer& surface, const std::string& where) {
    if (surface.isovalue && !std::isfinite(*surface.isovalue)) {
        refuse(where + ".isovalue is " + text(*surface.isovalue) + "; it must be a finite value of the volume");
    }
    for (int c = 0; c < 3; ++c) {
        if (surface.colour[c] >= 0 && surface.colour[c] <= 1) continue;
        refuse(where + ".colour." + "xyz"[c] + " is " + text(surface.colour[c]) + "; it must be 0 to 1");
    }
    if (surface.fog && !(*surface.fog > 0 && *surface.fog <= 1)) {
        refuse(where + ".fog is " + text(*surface.fog) + "; it must be above 0 and at most 1");
    }
    if (!surface.colour_by) return;
    if (surface.colour_by->image_id.empty()) {
        refuse(where + ".colour_by.image_id is empty; it names a scalar volume of the catalogue");
    }
    if (surface.colour_by->range) checkRange(*surface.colour_by->range, where + ".colour_by");
}

void checkIsosurfaces(const IsosurfaceSettings& settings) {
    if (!(settings.step >= 0.05F && settings.step <= 4)) {
        refuse("quality.isosurface.step is " + text(settings.step) + "; it must be 0.05 to 4 voxel edges");
    }
    if (settings.bisections < 0 || settings.bisections > 32) {
        refuse("quality.isosurface.bisections is " + text(settings.bisections) + "; it must be 0 to 32");
    }
}

void checkLayer(const Layer& layer, const std::string& where) {
    const std::string content = where + (layer.ifGlyphs() ? ".glyphs" : layer.ifTracts() ? ".tractogram" : ".isosurface");
    if (layer.datasetId().empty()) refuse(content + ".dataset_id is empty; the catalogue lists the ids");
    std::visit([&content](const auto& kind) { checkContent(kind, content); }, layer.content);
    if (!(layer.opacity > 0 && layer.opacity <= 1)) {
        refuse(where + ".opacity is " + text(layer.opacity) + "; it must be above 0 and at most 1");
    }
}

void checkRays(int rays, int rays_max, const std::string& field) {
    if (rays < 1 || rays > rays_max) {
        refuse(field + " is " + text(rays) + "; it must be 1 to " + text(rays_max));
    }
}

void checkLight(const Light& light, const Limits& limits) {
    if (light.direction_world) {
        checkDirection(*light.direction_world, "scene.light.direction_world");
    } else {
        checkDirection(light.direction_camera, "scene.light.direction_camera");
    }
    if (!(light.irradiance >= 0 && light.irradiance <= 100)) {
        refuse("scene.light.irradiance is " + text(light.irradiance) + "; it must be 0 to 100");
    }
    if (!(light.ambient >= 0 && light.ambient <= 10)) {
        refuse("scene.light.ambient is " + text(light.ambient) + "; it must be 0 to 10");
    }
    if (!(light.angular_radius_deg > 0 && light.angular_radius_deg <= limits.angular_radius_max_deg)) {
        refuse("scene.light.angular_radius_deg is " + text(light.angular_radius_deg) + "; it must be above 0 and at most " +
               text(limits.angular_radius_max_deg));
    }
    checkRays(light.shadow_rays, limits.shadow_rays_max, "scene.light.shadow_rays");
    if (!light.ambient_occlusion) return;
    const AmbientOcclusion& occlusion = *light.ambient_occlusion;
    checkRays(occlusion.rays, limits.occlusion_rays_max, "scene.light.ambient_occlusion.rays");
    if (occlusion.radius_mm && !(*occlusion.radius_mm > 0 && std::isfinite(*occlusion.radius_mm))) {
        refuse("scene.light.ambient_occlusion.radius_mm is " + text(*occlusion.radius_mm) + "; it must be finite and above 0");
    }
}

void checkTensorMarch(const TensorMarchSettings& settings) {
    const std::string where = "quality.tensor_march.";
    if (!(settings.step >= 0.001F && settings.step <= 0.5F)) {
        refuse(where + "step is " + text(settings.step) + "; it must be 0.001 to 0.5 radii");
    }
    if (settings.bisections < 0 || settings.bisections > 3) {
        refuse(where + "bisections is " + text(settings.bisections) + "; it must be 0 to 3");
    }
    if (settings.depth < 4 || settings.depth > 16) {
        refuse(where + "depth is " + text(settings.depth) + "; it must be 4 to 16");
    }
}

void checkMethod(const Quality& quality, const Limits& limits) {
    const RayMarchSettings& march = quality.ray_march;
    if (march.steps < 1 || march.steps > limits.ray_march_steps_max) {
        refuse("quality.ray_march.steps is " + text(march.steps) + "; it must be 1 to " + text(limits.ray_march_steps_max));
    }
    if (march.refinements && (*march.refinements < 0 || *march.refinements > 32)) {
        refuse("quality.ray_march.refinements is " + text(*march.refinements) + "; it must be 0 to 32");
    }
    const std::optional<double>& tolerance = quality.polynomial.tolerance;
    if (tolerance && !(*tolerance >= 1e-15 && *tolerance <= 0.1)) {
        std::ostringstream value;
        value << *tolerance;
        refuse("quality.polynomial.tolerance is " + value.str() + "; it must be 1e-15 to 0.1");
    }
    const bool table_off = quality.pole_table == PoleTable::kOff;
    if (quality.intersection == Intersection::kPoleTable && table_off) {
        refuse("quality.pole_table is off, which contradicts the method pole-table; use the method march");
    }
}

void checkScene(const Scene& scene, const Limits& limits) {
    if (scene.layers.empty()) refuse("scene.layers is empty; a picture needs at least one layer");
    if (scene.layers.size() > static_cast<std::size_t>(limits.layers_max)) {
        throw Error(Code::kResourceExhausted, "scene.layers has " + text(scene.layers.size()) +
                                                  " layers; the server draws at most " + text(limits.layers_max));
    }
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        checkLayer(scene.layers[i], "scene.layers[" + text(i) + "]");
    }
    checkLight(scene.light, limits);
    if (scene.light.illumination) validate(*scene.light.illumination, "scene.light.illumination");
    checkRgb(glm::dvec3(scene.background), "scene.background");
}

}  // namespace

void validate(const FrameRequest& request, const Limits& limits) {
    if (request.width < 1 || request.height < 1) {
        refuse("picture size is " + text(request.width) + "x" + text(request.height) + " pixels; both must be at least 1");
    }
    if (request.width > limits.width_max || request.height > limits.height_max ||
        static_cast<std::uint64_t>(request.width) * static_cast<std::uint64_t>(request.height) > limits.pixels_max) {
        throw Error(Code::kResourceExhausted, "picture size is " + text(request.width) + "x" + text(request.height) +
                                                  " pixels; at most " + text(limits.width_max) + "x" + text(limits.height_max) +
                                                  " and " + text(limits.pixels_max) + " in all are drawn");
    }
    if (request.quality.samples < 1 || request.quality.samples > limits.samples_max) {
        refuse("quality.samples is " + text(request.quality.samples) + "; it must be 1 to " + text(limits.samples_max));
    }
    if (request.quality.jpeg_quality < 1 || request.quality.jpeg_quality > 100) {
        refuse("quality.jpeg_quality is " + text(request.quality.jpeg_quality) + "; it must be 1 to 100");
    }
    if (request.quality.frozen_culling) {
        cameraFrame(*request.quality.frozen_culling);
        const FibletCulling culling = request.quality.fiblet_culling;
        if (culling != FibletCulling::kTwoPhase && culling != FibletCulling::kAuto) {
            refuse("quality.frozen_culling shows what two-phase culling leaves; fiblet_culling must be that, or be left open");
        }
        if (drawsUncompressed(request.quality.fiblet_pipeline)) {
            refuse("quality.frozen_culling needs fiblets; quality.fiblet_pipeline is " +
                   std::string(pipelineName(request.quality.fiblet_pipeline)) + ", which draws uncompressed points");
        }
    }
    if (const std::optional<float> detail = request.quality.fiblet_detail_px) {
        if (!(*detail >= kDetailMinPx && *detail <= kDetailMaxPx)) {
            refuse("quality.fiblet_detail_px is " + text(*detail) + "; it must be " + text(kDetailMinPx) + " to " +
                   text(kDetailMaxPx) + " pixels");
        }
        if (drawsUncompressed(request.quality.fiblet_pipeline)) {
            refuse("quality.fiblet_detail_px draws fewer lines than fiblets have segments; quality.fiblet_pipeline is " +
                   std::string(pipelineName(request.quality.fiblet_pipeline)) + ", which draws every uncompressed point");
        }
    }
    checkTensorMarch(request.quality.tensor_march);
    checkIsosurfaces(request.quality.isosurface);
    if (request.quality.intersection == Intersection::kTessellated) validate(request.quality.tessellation);
    checkMethod(request.quality, limits);
    checkScene(request.scene, limits);
    const Intersection method = request.quality.intersection;
    const bool tensor_method = !marches(method) && !byPolynomial(method) && !byEqualSteps(method);
    for (const Layer& layer : request.scene.layers) {
        const GlyphLayer* glyphs = layer.ifGlyphs();
        if (tensor_method && glyphs && glyphs->isotropic_part > 0) {
            refuse("quality.intersection draws tensors as they are; an isotropic_part needs march or polynomial");
        }
    }
    cameraFrame(request.camera);
}

}  // namespace radiata::model
