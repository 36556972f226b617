// What was picked.
#include "service/convert.h"

namespace radiata::service {

namespace {

void fill(v1::PickResponse& message, const model::PickedGlyph& picked) {
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
}

void fill(v1::PickResponse& message, const model::PickedSurface& picked) {
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
    std::visit([&message](const auto& what) { fill(message, what); }, picked);
    return message;
}

}  // namespace radiata::service
