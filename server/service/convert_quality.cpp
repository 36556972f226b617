// Quality: how a picture is made.
#include <array>
#include <utility>

#include "service/convert.h"
#include "service/convert_checks.h"

namespace radiata::service {
namespace {

using model::Intersection;

constexpr std::array<std::pair<v1::IntersectionMethod, Intersection>, 11> kMethods = {{
    {v1::INTERSECTION_METHOD_MARCH, Intersection::kMarch},
    {v1::INTERSECTION_METHOD_POLE_TABLE, Intersection::kPoleTable},
    {v1::INTERSECTION_METHOD_POLYNOMIAL, Intersection::kPolynomial},
    {v1::INTERSECTION_METHOD_POLYNOMIAL_DOUBLE, Intersection::kPolynomialDouble},
    {v1::INTERSECTION_METHOD_LAGUERRE, Intersection::kLaguerre},
    {v1::INTERSECTION_METHOD_RAY_MARCH_PEETERS, Intersection::kRayMarchPeeters},
    {v1::INTERSECTION_METHOD_RAY_MARCH_VAN_ALMSICK, Intersection::kRayMarchVanAlmsick},
    {v1::INTERSECTION_METHOD_TENSOR_MARCH, Intersection::kTensorMarch},
    {v1::INTERSECTION_METHOD_TENSOR_INTERVAL, Intersection::kTensorInterval},
    {v1::INTERSECTION_METHOD_TENSOR_AFFINE, Intersection::kTensorAffine},
    {v1::INTERSECTION_METHOD_TESSELLATED, Intersection::kTessellated},
}};

Intersection methodOf(v1::IntersectionMethod method) {
    for (const auto& [message, model] : kMethods) {
        if (message == method) return model;
    }
    return Intersection::kMarch;
}

v1::IntersectionMethod methodOf(Intersection method) {
    for (const auto& [message, model] : kMethods) {
        if (model == method) return message;
    }
    return v1::INTERSECTION_METHOD_UNSPECIFIED;
}

/// What is absent as the method takes it, so that a request is equal to its echo.
void readPolynomial(const v1::PolynomialSettings& settings, const std::string& where, model::Quality& result) {
    checkEnum(settings.stop(), v1::PolynomialSettings::Stop_IsValid, v1::PolynomialSettings::Stop_MAX, where + ".stop");
    result.polynomial.bracket_stop = settings.stop() != v1::PolynomialSettings::STOP_STEP;
    if (settings.has_tolerance()) result.polynomial.tolerance = settings.tolerance();
    if (model::byPolynomial(result.intersection)) {
        result.polynomial.tolerance = model::polynomialTolerance(result.intersection, result.polynomial);
    }
}

void readRayMarch(const v1::RayMarchSettings& settings, const std::string& where, model::Quality& result) {
    if (settings.has_steps()) result.ray_march.steps = toInt(settings.steps(), where + ".steps");
    if (settings.has_refinements()) result.ray_march.refinements = toInt(settings.refinements(), where + ".refinements");
    if (model::byEqualSteps(result.intersection)) {
        result.ray_march.refinements = model::rayMarchRefinements(result.intersection, result.ray_march);
    }
}

v1::PolynomialSettings polynomialProto(const model::PolynomialSettings& settings) {
    v1::PolynomialSettings message;
    message.set_stop(settings.bracket_stop ? v1::PolynomialSettings::STOP_BRACKET : v1::PolynomialSettings::STOP_STEP);
    if (settings.tolerance) message.set_tolerance(*settings.tolerance);
    return message;
}

v1::RayMarchSettings rayMarchProto(const model::RayMarchSettings& settings) {
    v1::RayMarchSettings message;
    message.set_steps(static_cast<std::uint32_t>(settings.steps));
    if (settings.refinements) message.set_refinements(static_cast<std::uint32_t>(*settings.refinements));
    return message;
}

/// Those that the method looks at, and of the others what was asked for.
void setMethodSettings(v1::Quality& message, const model::Quality& quality) {
    const Intersection method = quality.intersection;
    const bool tensor = method == Intersection::kTensorMarch || method == Intersection::kTensorInterval ||
                        method == Intersection::kTensorAffine;
    const model::Quality unset;
    if (model::byPolynomial(method) || quality.polynomial != unset.polynomial) {
        *message.mutable_polynomial() = polynomialProto(quality.polynomial);
        // Which has no stop; absent it is read as the one that is left out here.
        if (method == Intersection::kLaguerre && quality.polynomial.bracket_stop) message.mutable_polynomial()->clear_stop();
    }
    if (model::byEqualSteps(method) || quality.ray_march != unset.ray_march) {
        *message.mutable_ray_march() = rayMarchProto(quality.ray_march);
    }
    if (tensor || quality.tensor_march != unset.tensor_march) {
        *message.mutable_tensor_march() = toProto(quality.tensor_march);
    }
    if (method == Intersection::kTessellated || quality.tessellation != unset.tessellation) {
        *message.mutable_tessellation() = toProto(quality.tessellation);
    }
}

}  // namespace

model::Quality fromProto(const v1::Quality& quality, const std::string& where) {
    checkEnum(quality.intersection(), v1::IntersectionMethod_IsValid, v1::IntersectionMethod_MAX, where + ".intersection");
    checkEnum(quality.traversal(), v1::Traversal_IsValid, v1::Traversal_MAX, where + ".traversal");
    checkEnum(quality.pole_table(), v1::PoleTable_IsValid, v1::PoleTable_MAX, where + ".pole_table");
    checkEnum(quality.sun_table(), v1::PoleTable_IsValid, v1::PoleTable_MAX, where + ".sun_table");
    checkEnum(quality.glyph_boxes(), v1::GlyphBoxes_IsValid, v1::GlyphBoxes_MAX, where + ".glyph_boxes");
    checkEnum(quality.fiblet_pipeline(), v1::FibletPipeline_IsValid, v1::FibletPipeline_MAX, where + ".fiblet_pipeline");
    checkEnum(quality.fiblet_culling(), v1::FibletCulling_IsValid, v1::FibletCulling_MAX, where + ".fiblet_culling");
    model::Quality result;
    result.fiblet_pipeline = pipelineOf(quality.fiblet_pipeline());
    result.fiblet_culling = cullingOf(quality.fiblet_culling());
    if (quality.has_frozen_culling()) result.frozen_culling = fromProto(quality.frozen_culling(), where + ".frozen_culling");
    if (quality.has_fiblet_detail_px()) result.fiblet_detail_px = quality.fiblet_detail_px();
    if (quality.has_samples()) result.samples = toInt(quality.samples(), where + ".samples");
    if (quality.has_jpeg_quality()) result.jpeg_quality = toInt(quality.jpeg_quality(), where + ".jpeg_quality");
    result.intersection = methodOf(quality.intersection());
    readPolynomial(quality.polynomial(), where + ".polynomial", result);
    readRayMarch(quality.ray_march(), where + ".ray_march", result);
    result.tensor_march = fromProto(quality.tensor_march(), where + ".tensor_march");
    result.tessellation = fromProto(quality.tessellation(), where + ".tessellation");
    result.isosurface = fromProto(quality.isosurface(), where + ".isosurface");
    result.fxaa = quality.fxaa();
    if (quality.glyph_boxes() == v1::GLYPH_BOXES_CYLINDER) result.glyph_boxes = model::GlyphBoxes::kCylinder;
    switch (quality.traversal()) {
        case v1::TRAVERSAL_RAY_QUERY:
            result.traversal = model::Traversal::kRayQuery;
            break;
        case v1::TRAVERSAL_BVH:
            result.traversal = model::Traversal::kBvh;
            break;
        case v1::TRAVERSAL_TILES:
            result.traversal = model::Traversal::kTiles;
            break;
        case v1::TRAVERSAL_RASTER_BOXES:
            result.traversal = model::Traversal::kRasterBoxes;
            break;
        default:
            break;
    }
    if (quality.pole_table() == v1::POLE_TABLE_ON) result.pole_table = model::PoleTable::kOn;
    if (quality.pole_table() == v1::POLE_TABLE_OFF) result.pole_table = model::PoleTable::kOff;
    if (quality.sun_table() == v1::POLE_TABLE_ON) result.sun_table = model::PoleTable::kOn;
    if (quality.sun_table() == v1::POLE_TABLE_OFF) result.sun_table = model::PoleTable::kOff;
    return result;
}

v1::Quality toProto(const model::Quality& quality) {
    v1::Quality message;
    message.set_samples(static_cast<std::uint32_t>(quality.samples));
    message.set_fiblet_pipeline(pipelineOf(quality.fiblet_pipeline));
    message.set_fiblet_culling(cullingOf(quality.fiblet_culling));
    message.set_fxaa(quality.fxaa);
    if (quality.frozen_culling) *message.mutable_frozen_culling() = toProto(*quality.frozen_culling);
    if (quality.fiblet_detail_px) message.set_fiblet_detail_px(*quality.fiblet_detail_px);
    *message.mutable_isosurface() = toProto(quality.isosurface);
    message.set_jpeg_quality(static_cast<std::uint32_t>(quality.jpeg_quality));
    message.set_intersection(methodOf(quality.intersection));
    setMethodSettings(message, quality);
    message.set_glyph_boxes(quality.glyph_boxes == model::GlyphBoxes::kCylinder ? v1::GLYPH_BOXES_CYLINDER
                                                                                : v1::GLYPH_BOXES_TIGHT);
    switch (quality.traversal) {
        case model::Traversal::kAuto:
            break;
        case model::Traversal::kRayQuery:
            message.set_traversal(v1::TRAVERSAL_RAY_QUERY);
            break;
        case model::Traversal::kBvh:
            message.set_traversal(v1::TRAVERSAL_BVH);
            break;
        case model::Traversal::kTiles:
            message.set_traversal(v1::TRAVERSAL_TILES);
            break;
        case model::Traversal::kRasterBoxes:
            message.set_traversal(v1::TRAVERSAL_RASTER_BOXES);
            break;
    }
    if (quality.pole_table == model::PoleTable::kOn) message.set_pole_table(v1::POLE_TABLE_ON);
    if (quality.pole_table == model::PoleTable::kOff) message.set_pole_table(v1::POLE_TABLE_OFF);
    if (quality.sun_table == model::PoleTable::kOn) message.set_sun_table(v1::POLE_TABLE_ON);
    if (quality.sun_table == model::PoleTable::kOff) message.set_sun_table(v1::POLE_TABLE_OFF);
    return message;
}

}  // namespace radiata::service
