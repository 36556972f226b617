// Layers of fibres.
#include "service/convert.h"
#include "service/convert_checks.h"

namespace radiata::service {
namespace {

glm::dvec3 vectorOf(const v1::Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }

template <typename Message>
void mapFromProto(const Message& message, model::FibreColour& colour, const std::string& where) {
    colour.map = fromProto(message.map(), where + ".map");
    if (message.has_range()) colour.range = model::FibreColourRange{message.range().low(), message.range().high()};
}

template <typename Message>
void mapToProto(const model::FibreColour& colour, Message& message) {
    message.set_map(toProto(colour.map));
    if (!colour.range) return;
    message.mutable_range()->set_low(colour.range->low);
    message.mutable_range()->set_high(colour.range->high);
}

model::FibreColour colourOf(const v1::FibreColour& colour, const std::string& where) {
    model::FibreColour result;
    switch (colour.source_case()) {
        case v1::FibreColour::kUniform:
            result.mode = model::FibreColourMode::kUniform;
            result.uniform = glm::vec3(vectorOf(colour.uniform()));
            break;
        case v1::FibreColour::kFibre:
            result.mode = model::FibreColourMode::kFibre;
            break;
        case v1::FibreColour::kGroup:
            result.mode = model::FibreColourMode::kGroup;
            break;
        case v1::FibreColour::kColumn:
            result.mode = model::FibreColourMode::kColumn;
            result.column = colour.column().name();
            mapFromProto(colour.column(), result, where + ".column");
            break;
        case v1::FibreColour::kLength:
            result.mode = model::FibreColourMode::kLength;
            mapFromProto(colour.length(), result, where + ".length");
            break;
        case v1::FibreColour::kDirection:
        case v1::FibreColour::SOURCE_NOT_SET:
            break;
    }
    return result;
}

v1::FibreColour colourOf(const model::FibreColour& colour) {
    v1::FibreColour message;
    switch (colour.mode) {
        case model::FibreColourMode::kDirection:
            message.mutable_direction();
            break;
        case model::FibreColourMode::kUniform:
            *message.mutable_uniform() = toProto(glm::dvec3(colour.uniform));
            break;
        case model::FibreColourMode::kFibre:
            message.mutable_fibre();
            break;
        case model::FibreColourMode::kGroup:
            message.mutable_group();
            break;
        case model::FibreColourMode::kColumn:
            message.mutable_column()->set_name(colour.column);
            mapToProto(colour, *message.mutable_column());
            break;
        case model::FibreColourMode::kLength:
            mapToProto(colour, *message.mutable_length());
            break;
    }
    return message;
}

model::FibreSet setOf(const v1::FibreSet& set) {
    model::FibreSet result;
    result.groups.assign(set.groups().begin(), set.groups().end());
    result.fibres.assign(set.fibres().begin(), set.fibres().end());
    if (set.has_length_min_mm()) result.length_min_mm = set.length_min_mm();
    if (set.has_length_max_mm()) result.length_max_mm = set.length_max_mm();
    return result;
}

v1::FibreSet setOf(const model::FibreSet& set) {
    v1::FibreSet message;
    for (const std::string& group : set.groups) message.add_groups(group);
    for (const std::uint32_t fibre : set.fibres) message.add_fibres(fibre);
    if (set.length_min_mm) message.set_length_min_mm(*set.length_min_mm);
    if (set.length_max_mm) message.set_length_max_mm(*set.length_max_mm);
    return message;
}

}  // namespace

model::TractogramLayer fromProto(const v1::TractogramLayer& layer, const std::string& where) {
    checkEnum(layer.unselected(), v1::UnselectedFibres_IsValid, v1::UnselectedFibres_MAX, where + ".unselected");
    model::TractogramLayer result;
    result.dataset_id = layer.dataset_id();
    result.colour = colourOf(layer.colour(), where + ".colour");
    if (layer.has_line_width_px()) result.line_width_px = toInt(layer.line_width_px(), where + ".line_width_px");
    if (layer.has_tube_radius_mm()) result.tube_radius_mm = layer.tube_radius_mm();
    if (layer.has_occlusion_px()) result.occlusion_px = layer.occlusion_px();
    if (layer.has_halo_px()) result.halo_px = layer.halo_px();
    for (const v1::FibreCut& cut : layer.cuts()) result.cuts.push_back({vectorOf(cut.point_mm()), vectorOf(cut.normal())});
    result.shown = setOf(layer.shown());
    if (layer.has_selected()) result.selected = setOf(layer.selected());
    if (layer.unselected() == v1::UNSELECTED_FIBRES_HIDDEN) result.unselected = model::UnselectedFibres::kHidden;
    return result;
}

v1::TractogramLayer toProto(const model::TractogramLayer& layer) {
    v1::TractogramLayer message;
    message.set_dataset_id(layer.dataset_id);
    *message.mutable_colour() = colourOf(layer.colour);
    message.set_line_width_px(static_cast<std::uint32_t>(layer.line_width_px));
    if (layer.tube_radius_mm) message.set_tube_radius_mm(*layer.tube_radius_mm);
    if (layer.occlusion_px) message.set_occlusion_px(*layer.occlusion_px);
    if (layer.halo_px) message.set_halo_px(*layer.halo_px);
    for (const model::FibreCut& cut : layer.cuts) {
        v1::FibreCut* added = message.add_cuts();
        *added->mutable_point_mm() = toProto(cut.point_mm);
        *added->mutable_normal() = toProto(cut.normal);
    }
    if (!layer.shown.isAll()) *message.mutable_shown() = setOf(layer.shown);
    if (layer.selected) *message.mutable_selected() = setOf(*layer.selected);
    message.set_unselected(layer.unselected == model::UnselectedFibres::kHidden ? v1::UNSELECTED_FIBRES_HIDDEN
                                                                                : v1::UNSELECTED_FIBRES_DIMMED);
    return message;
}

// Numbered alike.
model::FibletPipeline pipelineOf(v1::FibletPipeline pipeline) { return static_cast<model::FibletPipeline>(pipeline); }
v1::FibletPipeline pipelineOf(model::FibletPipeline pipeline) { return static_cast<v1::FibletPipeline>(pipeline); }
static_assert(static_cast<int>(model::FibletPipeline::kPoints) == v1::FIBLET_PIPELINE_POINTS);

model::FibletCulling cullingOf(v1::FibletCulling culling) {
    switch (culling) {
        case v1::FIBLET_CULLING_FRUSTUM:
            return model::FibletCulling::kFrustum;
        case v1::FIBLET_CULLING_NONE:
            return model::FibletCulling::kNone;
        case v1::FIBLET_CULLING_COVERAGE:
            return model::FibletCulling::kCoverage;
        default:
            return model::FibletCulling::kTwoPhase;
    }
}

v1::FibletCulling cullingOf(model::FibletCulling culling) {
    switch (culling) {
        case model::FibletCulling::kFrustum:
            return v1::FIBLET_CULLING_FRUSTUM;
        case model::FibletCulling::kNone:
            return v1::FIBLET_CULLING_NONE;
        case model::FibletCulling::kCoverage:
            return v1::FIBLET_CULLING_COVERAGE;
        case model::FibletCulling::kTwoPhase:
            break;
    }
    return v1::FIBLET_CULLING_TWO_PHASE;
}

}  // namespace radiata::service
