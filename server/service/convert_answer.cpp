// What the server answers: frames, datasets, limits.
#include <cstring>
#include <type_traits>

#include "math/cartesian_tensor.h"
#include "math/sh_layout.h"
#include "service/convert.h"

namespace radiata::service {
namespace {

v1::FrameState stateOf(model::FrameState state) {
    switch (state) {
        case model::FrameState::kInteractive:
            return v1::FRAME_STATE_INTERACTIVE;
        case model::FrameState::kRefining:
            return v1::FRAME_STATE_REFINING;
        case model::FrameState::kConverged:
            return v1::FRAME_STATE_CONVERGED;
    }
    return v1::FRAME_STATE_UNSPECIFIED;
}

/// \param channels  values per pixel; 0: the array has no third dimension
template <typename Value>
void addOutput(v1::Frame& message, v1::Output output, std::vector<Value>& values, std::uint32_t channels) {
    static_assert(sizeof(Value) == 4 && std::is_trivially_copyable_v<Value>);
    v1::OutputArray* array = message.add_outputs();
    array->set_output(output);
    array->add_shape(message.height());
    array->add_shape(message.width());
    if (channels != 0) array->add_shape(channels);
    array->set_data(values.data(), values.size() * sizeof(Value));
    std::vector<Value>().swap(values);
}

void fillInfo(v1::Frame& message, const model::FrameInfo& info) {
    message.set_state(stateOf(info.state));
    message.set_samples(static_cast<std::uint32_t>(info.samples));
    for (const model::PassTime& pass : info.passes) {
        v1::PassTime* added = message.add_passes();
        added->set_name(pass.name);
        added->set_shader(pass.shader);
        added->set_time_ms(pass.time_ms);
    }
    v1::Methods* methods = message.mutable_methods();
    const v1::Quality quality = toProto(info.request.quality);
    methods->set_intersection(quality.intersection());
    methods->set_traversal(quality.traversal());
    methods->set_pole_table(info.pole_table_used);
    methods->set_pole_table_reason(info.pole_table_reason);
    methods->set_traversal_reason(info.traversal_reason);
    methods->set_sun_table(info.sun_table_used);
    methods->set_sun_table_reason(info.sun_table_reason);
    message.set_depth_offset_mm(info.depth_offset_mm);
    for (int axis = 0; axis < 3; ++axis) message.add_position_origin_mm(info.position_origin_mm[axis]);
    v1::Counters* counters = message.mutable_counters();
    counters->set_glyphs(info.glyphs);
    counters->set_glyphs_available(info.glyphs_available);
    counters->set_hit_pixels(info.hit_pixels);
    counters->set_capped_rays(info.capped_rays);
    counters->set_fiblets(info.fiblets);
    counters->set_fiblets_drawn(info.fiblets_drawn);
    counters->set_fiblet_error_px(info.fiblet_error_px);
    counters->set_fiblet_pages_wanted(info.fiblet_pages_wanted);
    counters->set_fiblet_pages_resident(info.fiblet_pages_resident);
    counters->set_fiblet_pages_left_out(info.fiblet_pages_left_out);
    counters->set_fiblet_bytes_read(info.fiblet_bytes_read);
    for (const model::LeftOut& left_out : info.left_out) {
        v1::LeftOut* added = message.add_left_out();
        added->set_layer(static_cast<std::uint32_t>(left_out.layer));
        added->set_lmax(static_cast<std::uint32_t>(left_out.lmax));
        added->set_lmax_available(static_cast<std::uint32_t>(left_out.lmax_available));
        added->set_voxels_not_finite(left_out.voxels_not_finite);
        added->set_glyphs_out_of_range(left_out.glyphs_out_of_range);
        added->set_glyphs_without_lobes(left_out.glyphs_without_lobes);
        for (const std::string& text : model::leftOutTexts(left_out, info.request.scene.layers.size() > 1)) {
            added->add_texts(text);
        }
    }
    message.set_device(info.device);
    if (info.illumination) *message.mutable_illumination() = toProto(*info.illumination);
}

}  // namespace

v1::Frame toProto(session::StreamFrame&& frame, const model::Outputs& outputs) {
    v1::Frame message;
    message.set_sequence(frame.sequence);
    message.set_camera_sequence(frame.camera_sequence);
    message.set_format(frame.format == session::ImageFormat::kPng ? v1::IMAGE_FORMAT_PNG : v1::IMAGE_FORMAT_JPEG);
    message.set_image(frame.image.data(), frame.image.size());
    message.set_width(static_cast<std::uint32_t>(frame.width));
    message.set_height(static_cast<std::uint32_t>(frame.height));
    fillInfo(message, frame.info);
    v1::Timing* timing = message.mutable_timing();
    timing->set_queue_ms(frame.timing.queue_ms);
    timing->set_render_ms(frame.timing.render_ms);
    timing->set_encode_ms(frame.timing.encode_ms);
    timing->set_total_ms(frame.timing.total_ms);
    timing->set_client_time_ms(frame.timing.client_time_ms);
    if (frame.echo_request) *message.mutable_request() = toProto(frame.info.request);
    if (outputs.depth) addOutput(message, v1::OUTPUT_DEPTH, frame.outputs.depth, 0);
    if (outputs.id) addOutput(message, v1::OUTPUT_ID, frame.outputs.id, 4);
    if (outputs.position) addOutput(message, v1::OUTPUT_POSITION, frame.outputs.position, 3);
    if (outputs.normal) addOutput(message, v1::OUTPUT_NORMAL, frame.outputs.normal, 3);
    if (outputs.steps) addOutput(message, v1::OUTPUT_STEPS, frame.outputs.steps, 0);
    return message;
}

v1::Dataset toProto(const model::DatasetInfo& info) {
    v1::Dataset message;
    message.set_id(info.id);
    message.set_kind(info.kind == model::DatasetKind::kTractogram       ? v1::DATASET_KIND_TRACTOGRAM
                     : info.kind == model::DatasetKind::kScalarVolume   ? v1::DATASET_KIND_SCALAR_VOLUME
                     : info.kind == model::DatasetKind::kEnvironmentMap ? v1::DATASET_KIND_ENVIRONMENT_MAP
                     : info.kind == model::DatasetKind::kMesh           ? v1::DATASET_KIND_MESH
                     : info.tensor_order > 0                            ? v1::DATASET_KIND_TENSOR_IMAGE
                                                                        : v1::DATASET_KIND_SH_IMAGE);
    message.set_tensor_order(static_cast<std::uint32_t>(info.tensor_order));
    for (int axis = 0; axis < 3; ++axis) message.add_size(static_cast<std::uint32_t>(info.size[axis]));
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) message.mutable_voxel_to_world()->add_rows(info.voxel_to_world[column][row]);
    }
    if (info.kind == model::DatasetKind::kShImage) {
        message.set_lmax(static_cast<std::uint32_t>(info.layout.lmax));
        message.set_full_basis(info.layout.full);
        message.set_convention(info.tensor_order > 0 ? info.tensor_format : std::string(name(info.convention)));
        message.set_axes(std::string(name(info.axes)));
    }
    message.set_fibres(info.fibres);
    message.set_points(info.points);
    message.set_triangles(info.triangles);
    for (const model::FibreGroupSize& group : info.fibre_groups) {
        v1::FibreGroupSize* added = message.add_fibre_groups();
        added->set_name(group.name);
        added->set_fibres(group.fibres);
    }
    message.mutable_fibre_columns()->Add(info.fibre_columns.begin(), info.fibre_columns.end());
    message.mutable_vertex_columns()->Add(info.vertex_columns.begin(), info.vertex_columns.end());
    message.set_remarks(info.remarks);
    message.set_step_mm(info.step_mm);
    message.set_set_anew_mean_um(info.set_anew_mean_um);
    message.set_set_anew_max_um(info.set_anew_max_um);
    message.set_error_mean_um(info.error_mean_um);
    message.set_error_max_um(info.error_max_um);
    message.set_value_min(info.value_min);
    message.set_value_max(info.value_max);
    message.set_glyph_count(info.glyph_count);
    message.set_rejected_voxels(info.rejected_voxels);
    message.set_amplitude_max(info.amplitude_max);
    message.set_amplitude_typical(info.amplitude_typical);
    message.set_gpu_bytes(info.gpu_bytes);
    message.set_fiblet_pages(info.fiblet_pages);
    message.set_resident_pages(info.resident_pages);
    *message.mutable_bounds_world()->mutable_minimum() = toProto(info.bounds_min);
    *message.mutable_bounds_world()->mutable_maximum() = toProto(info.bounds_max);
    return message;
}

v1::GetLimitsResponse toProto(const model::Limits& limits, const session::Backend& backend) {
    v1::GetLimitsResponse message;
    message.set_width_max(static_cast<std::uint32_t>(limits.width_max));
    message.set_height_max(static_cast<std::uint32_t>(limits.height_max));
    message.set_pixels_max(limits.pixels_max);
    message.set_mesh_vertices_max(static_cast<std::uint32_t>(model::kMeshVerticesMax));
    message.set_layer_triangles_max(model::kLayerTrianglesMax);
    message.set_ray_march_steps_max(static_cast<std::uint32_t>(limits.ray_march_steps_max));
    message.set_band_max(static_cast<std::uint32_t>(kLmaxLimit));
    message.set_tensor_order_max(static_cast<std::uint32_t>(kTensorOrderMax));
    message.set_samples_max(static_cast<std::uint32_t>(limits.samples_max));
    message.set_layers_max(static_cast<std::uint32_t>(limits.layers_max));
    message.set_views_max(static_cast<std::uint32_t>(limits.views_max));
    message.set_window_max(static_cast<std::uint32_t>(limits.window_max));
    message.set_message_bytes_max(limits.message_bytes_max);
    message.set_tract_memory_bytes(limits.tract_memory_bytes);
    message.set_device(backend.device);
    for (const std::string& traversal : backend.traversals) message.add_traversals(traversal);
    message.set_version(RADIATA_VERSION);
    message.set_shadow_rays_max(static_cast<std::uint32_t>(limits.shadow_rays_max));
    message.set_occlusion_rays_max(static_cast<std::uint32_t>(limits.occlusion_rays_max));
    message.set_angular_radius_max_deg(limits.angular_radius_max_deg);
    return message;
}

}  // namespace radiata::service
