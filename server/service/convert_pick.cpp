// What was picked.
#include "service/convert.h"

namespace radiata::service {

namespace {

void setPicked(const model::PickedGlyph& picked, v1::PickResponse& message) {
    v1::PickedGlyph& glyph = *message.mutable_glyph();
    glyph.set_layer(static_cast<std::uint32_t>(picked.layer));
    glyph.set_dataset_id(picked.dataset_id);
    for (int axis = 0; axis < 3; ++axis) glyph.add_voxel(static_cast<std::uint32_t>(picked.voxel[axis]));
    *glyph.mutable_centre_mm() = toProto(picked.centre_mm);
    *glyph.mutable_position_mm() = toProto(picked.position_mm);
    *glyph.mutable_direction() = toProto(picked.direction);
    glyph.set_radius_mm(picked.radius_mm);
    glyph.set_amplitude(picked.amplitude);
    glyph.set_peak_rank(static_cast<std::uint32_t>(picked.peak_rank));
    glyph.set_peak_angle_deg(picked.peak_angle_deg);
    for (const model::Peak& peak : picked.peaks) {
        v1::Peak& added = *glyph.add_peaks();
        *added.mutable_direction() = toProto(peak.direction);
        added.set_amplitude(peak.amplitude);
    }
    for (const model::RayHit& hit : picked.hits) {
        v1::RayHit& added = *glyph.add_hits();
        added.set_distance_mm(hit.distance_mm);
        *added.mutable_position_mm() = toProto(hit.position_mm);
        *added.mutable_direction() = toProto(hit.direction);
        added.set_radius_mm(hit.radius_mm);
        added.set_negative_lobe(hit.negative_lobe);
        added.set_leaving(hit.leaving);
    }
}

void setPicked(const model::PickedFibre& picked, v1::PickResponse& message) {
    v1::PickedFibre& fibre = *message.mutable_fibre();
    fibre.set_layer(static_cast<std::uint32_t>(picked.layer));
    fibre.set_dataset_id(picked.dataset_id);
    fibre.set_fibre(picked.fibre);
    fibre.set_point(picked.point);
    *fibre.mutable_position_mm() = toProto(picked.position_mm);
    *fibre.mutable_tangent() = toProto(picked.tangent);
    fibre.set_length_mm(picked.length_mm);
    fibre.set_distance_px(picked.distance_px);
    for (const std::string& group : picked.groups) fibre.add_groups(group);
    for (const model::FibreValue& value : picked.values) {
        v1::FibreValue& added = *fibre.add_values();
        added.set_column(value.column);
        for (const float number : value.numbers) added.add_numbers(number);
    }
}

void setPicked(const model::PickedSurface& picked, v1::PickResponse& message) {
    v1::PickedSurface& surface = *message.mutable_surface();
    surface.set_layer(static_cast<std::uint32_t>(picked.layer));
    surface.set_dataset_id(picked.dataset_id);
    for (int axis = 0; axis < 3; ++axis) surface.add_voxel(static_cast<std::uint32_t>(picked.voxel[axis]));
    *surface.mutable_position_mm() = toProto(picked.position_mm);
    *surface.mutable_normal() = toProto(picked.normal);
    surface.set_value(picked.value);
}

}  // namespace

v1::PickResponse toProto(const model::Picked& picked) {
    v1::PickResponse message;
    std::visit([&message](const auto& kind) { setPicked(kind, message); }, picked);
    return message;
}

}  // namespace radiata::service
