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
        case v1::FibreColour::kPoint:
            result.mode = model::FibreColourMode::kPointColumn;
            result.column = colour.point().name();
            result.component = toInt(colour.point().component(), where + ".point.component");
            mapFromProto(colour.point(), result, where + ".point");
            break;
        case v1::FibreColour::kDistance:
            result.mode = model::FibreColourMode::kDistance;
            result.region = colour.distance().region();
            mapFromProto(colour.distance(), result, where + ".distance");
            break;
        case v1::FibreColour::kEnds:
            result.mode = model::FibreColourMode::kEnds;
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
        case model::FibreColourMode::kPointColumn:
            message.mutable_point()->set_name(colour.column);
            message.mutable_point()->set_component(static_cast<std::uint32_t>(colour.component));
            mapToProto(colour, *message.mutable_point());
            break;
        case model::FibreColourMode::kDistance:
            message.mutable_distance()->set_region(colour.region);
            mapToProto(colour, *message.mutable_distance());
            break;
        case model::FibreColourMode::kEnds:
            message.mutable_ends();
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
    result.selection = set.selection();
    return result;
}

v1::FibreSet setOf(const model::FibreSet& set) {
    v1::FibreSet message;
    for (const std::string& group : set.groups) message.add_groups(group);
    for (const std::uint32_t fibre : set.fibres) message.add_fibres(fibre);
    if (set.length_min_mm) message.set_length_min_mm(*set.length_min_mm);
    if (set.length_max_mm) message.set_length_max_mm(*set.length_max_mm);
    message.set_selection(set.selection);
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
    result.exact_width = layer.exact_width();
    for (const v1::FibreRegionCut& cut : layer.region_cuts()) {
        result.region_cuts.push_back({cut.region(), cut.outside(), cut.by_depths()});
    }
    for (const v1::FibreCriterion& criterion : layer.criteria()) {
        result.criteria.push_back({criterion.column(), criterion.low(), criterion.high()});
    }
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
    message.set_exact_width(layer.exact_width);
    for (const model::FibreRegionCut& cut : layer.region_cuts) {
        v1::FibreRegionCut* added = message.add_region_cuts();
        added->set_region(cut.region);
        added->set_outside(cut.outside);
        added->set_by_depths(cut.by_depths);
    }
    for (const model::FibreCriterion& criterion : layer.criteria) {
        v1::FibreCriterion* added = message.add_criteria();
        added->set_column(criterion.column);
        added->set_low(criterion.low);
        added->set_high(criterion.high);
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

model::FibletCulling cullingOf(v1::FibletCulling culling) { return static_cast<model::FibletCulling>(culling); }
v1::FibletCulling cullingOf(model::FibletCulling culling) { return static_cast<v1::FibletCulling>(culling); }
static_assert(static_cast<int>(model::FibletCulling::kCoverage) == v1::FIBLET_CULLING_COVERAGE);

}  // namespace radiata::service
