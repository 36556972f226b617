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

void readPolynomial(const v1::PolynomialSettings& settings, const std::string& where, model::PolynomialSettings& result) {
    checkEnum(settings.stop(), v1::PolynomialSettings::Stop_IsValid, v1::PolynomialSettings::Stop_MAX, where + ".stop");
    result.bracket_stop = settings.stop() != v1::PolynomialSettings::STOP_STEP;
    if (settings.has_tolerance()) result.tolerance = settings.tolerance();
}

/// Only those that the method looks at.
void setMethodSettings(v1::Quality& message, const model::Quality& quality) {
    switch (quality.intersection) {
        case Intersection::kMarch:
        case Intersection::kPoleTable:
            return;
        case Intersection::kPolynomial:
        case Intersection::kPolynomialDouble:
            message.mutable_polynomial()->set_stop(quality.polynomial.bracket_stop ? v1::PolynomialSettings::STOP_BRACKET
                                                                                   : v1::PolynomialSettings::STOP_STEP);
            [[fallthrough]];
        case Intersection::kLaguerre:
            message.mutable_polynomial()->set_tolerance(model::polynomialTolerance(quality.intersection, quality.polynomial));
            return;
        case Intersection::kRayMarchPeeters:
        case Intersection::kRayMarchVanAlmsick:
            message.mutable_ray_march()->set_steps(static_cast<std::uint32_t>(quality.ray_march.steps));
            message.mutable_ray_march()->set_refinements(
                static_cast<std::uint32_t>(model::rayMarchRefinements(quality.intersection, quality.ray_march)));
            return;
        case Intersection::kTensorMarch:
        case Intersection::kTensorInterval:
        case Intersection::kTensorAffine:
            *message.mutable_tensor_march() = toProto(quality.tensor_march);
            return;
        case Intersection::kTessellated:
            *message.mutable_tessellation() = toProto(quality.tessellation);
            return;
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
    result.tessellation = fromProto(quality.tessellation(), where + ".tessellation");
    result.isosurface = fromProto(quality.isosurface(), where + ".isosurface");
    result.tensor_march = fromProto(quality.tensor_march(), where + ".tensor_march");
    readPolynomial(quality.polynomial(), where + ".polynomial", result.polynomial);
    if (quality.ray_march().has_steps())
        result.ray_march.steps = toInt(quality.ray_march().steps(), where + ".ray_march.steps");
    if (quality.ray_march().has_refinements()) {
        result.ray_march.refinements = toInt(quality.ray_march().refinements(), where + ".ray_march.refinements");
    }
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
