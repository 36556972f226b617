#include "render/frame/frame_parameters.h"

#include <algorithm>

#include "base/error.h"
#include "build/tile_lists.h"
#include "gpu/device.h"
#include "plan/plan_raster.h"
#include "render/frame/fiblet_buffers.h"

namespace radiata::render {
namespace {

constexpr std::size_t kTileEntriesMax = 24'000'000;
constexpr float kUnselectedLight = 0.25F;

/// Addresses of pixels are added when the layer is drawn.
void fillFibreLook(ColourTables& colours, const DrawList& list, std::size_t index, shader::LayerLook& look) {
    const model::FibreColour& colour = list.plan->resolved.scene.layers[index].tracts().colour;
    const plan::FibletPlan& fiblets = *list.plan->fiblets[index];
    const FibletScene& scene = *list.layers[index].tracts;
    look.instances = scene.residency() ? scene.placeAddress() : scene.headAddress();
    look.states = list.layers[index].fibres->stateAddress();
    const FibreColours& values = *list.layers[index].fibres->colours;
    look.values = values.valueAddress();
    look.point_ranges = values.rangeAddress();
    look.grid_origin = glm::vec3(values.grid().origin_mm - list.camera.reference_mm);
    look.grid_step = static_cast<float>(values.grid().step_mm);
    look.grid_size = values.grid().size;
    look.colour = static_cast<std::uint32_t>(colour.mode);
    look.uniform_colour = colour.uniform;
    look.tubes = fiblets.selected_only ? 2 : fiblets.tubes ? 1 : 0;
    look.occlusion_px = list.plan->resolved.scene.layers[index].tracts().occlusion_px.value_or(0);
    look.halo_px = list.plan->resolved.scene.layers[index].tracts().halo_px.value_or(0);
    look.unselected = fiblets.dimmed ? kUnselectedLight : 1;
    if (!colour.usesMap()) return;
    look.map = colours.address(colour.map);
    look.range_low = colour.range->low;
    look.range_high = colour.range->high;
}

shader::LayerLook layerLook(ColourTables& colours, const DrawList& list, std::size_t layer) {
    const model::Layer& wanted = list.plan->resolved.scene.layers[layer];
    shader::LayerLook look{};
    look.kind = static_cast<std::uint32_t>(wanted.content.index());
    look.opacity = wanted.opacity;
    if (list.layers[layer].tracts) fillFibreLook(colours, list, layer, look);
    if (const model::IsosurfaceLayer* surface = wanted.ifSurface()) {
        look.colour = shader::COLOUR_UNIFORM;
        look.uniform_colour = surface->colour;
        if (surface->colour_by) {
            look.map = colours.address(surface->colour_by->map);
            look.range_low = surface->colour_by->range->low;
            look.range_high = surface->colour_by->range->high;
        }
    }
    if (!list.layers[layer].glyphs) return look;
    GlyphScene& scene = *list.layers[layer].glyphs;
    const model::GlyphColour& colour = wanted.glyphs().colour;
    look.instances = scene.instanceBuffer().address();
    look.colour = static_cast<std::uint32_t>(colour.mode);
    look.uniform_colour = colour.uniform;
    if (!colour.usesMap()) return look;
    look.map = colours.address(colour.map);
    look.range_low = colour.range->low;
    look.range_high = colour.range->high;
    if (colour.mode == model::ColourMode::kScalar) look.values = scene.values(list.layers[layer].scalars).address();
    return look;
}

}  // namespace

shader::GlyphLayerParams glyphParameters(gpu::Device& device, const Target::Impl& target, LayerBuffers& buffers,
                                         GlyphScene& scene, const plan::GlyphPlan& glyphs,
                                         std::optional<model::Traversal> traversal, shader::FrameParams& frame) {
    shader::GlyphLayerParams params{};
    params.instances = scene.instanceBuffer().address();
    params.coefficients = scene.dataset().coefficients().address();
    params.count = static_cast<std::uint32_t>(scene.instances().size());
    params.stride = static_cast<std::uint32_t>(scene.dataset().image().layout.count());
    params.used = glyphs.used;
    params.both_lobes = glyphs.both_lobes ? 1 : 0;
    params.tensors = scene.tensorAddress();
    if (traversal == model::Traversal::kTiles) {
        const TileLists lists = buildTileLists(scene.instances(), frame.rays, target.width, target.height, kTileShiftX,
                                               kTileShiftY, kTileEntriesMax);
        if (!lists.complete) {
            throw Error(Code::kResourceExhausted, "quality.traversal tiles: this view needs more than " +
                                                      std::to_string(kTileEntriesMax) + " list entries; use auto or bvh");
        }
        ensureBytes(device, buffers.tile_ranges, std::span(lists.ranges).size_bytes(), gpu::Memory::kUpload, "tile ranges");
        ensureBytes(device, buffers.tile_entries, std::max<std::size_t>(std::span(lists.entries).size_bytes(), 4),
                    gpu::Memory::kUpload, "tile entries");
        std::copy(lists.ranges.begin(), lists.ranges.end(), buffers.tile_ranges.as<glm::uvec2>().begin());
        std::copy(lists.entries.begin(), lists.entries.end(), buffers.tile_entries.as<std::uint32_t>().begin());
        params.tile_ranges = buffers.tile_ranges.address();
        params.tile_lists = buffers.tile_entries.address();
        frame.tiles_x = static_cast<std::uint32_t>(lists.tiles_x);
        frame.tiles_y = static_cast<std::uint32_t>(lists.tiles_y);
    } else if (traversal == model::Traversal::kRayQuery && !scene.instances().empty()) {
        params.acceleration = scene.acceleration().address();
    } else if (traversal) {
        params.bvh_nodes = scene.bvhNodes().address();
        params.bvh_order = scene.bvhOrder().address();
    }
    if (glyphs.pole_table && params.count > 0) {
        // Plans of second glyphs are made for the march.
        const int k = std::stoi(glyphs.layout_name.substr(4));
        const bool full = glyphs.layout_name.starts_with("full");
        const std::uint64_t floats = glyphs.table_floats > 0 ? glyphs.table_floats : poleTableCount(k, full);
        ensureBytes(device, buffers.table, std::uint64_t{params.count} * floats * 4, gpu::Memory::kDevice, "pole-frame tables");
        params.tables = buffers.table.address();
    }
    return params;
}

void fillFrameParameters(gpu::Device& device, ColourTables& colours, Target::Impl& target, const DrawList& list) {
    shader::FrameParams& frame = target.frame();
    const model::FrameRequest& request = list.plan->resolved;
    frame.rays = list.camera.rays;
    frame.width = static_cast<std::uint32_t>(target.width);
    frame.height = static_cast<std::uint32_t>(target.height);
    frame.light_direction = glm::vec3(list.light_direction_world);
    frame.irradiance = request.scene.light.irradiance;
    frame.ambient = request.scene.light.ambient;
    frame.background = request.scene.background;
    frame.layer_count = static_cast<std::uint32_t>(list.layers.size());
    target.fiblets.resize(list.layers.size());
    for (std::size_t i = 0; i < list.layers.size(); ++i) {
        if (!list.layers[i].tracts) {
            target.fiblets[i].reset();
        } else if (!target.fiblets[i]) {
            target.fiblets[i] = std::make_unique<FibletBuffers>();
        }
        target.look(i) = layerLook(colours, list, i);
        if (!list.layers[i].glyphs) continue;
        GlyphScene& scene = *list.layers[i].glyphs;
        const plan::GlyphPlan& glyphs = list.plan->glyphs[i];
        std::optional<model::Traversal> traversal = request.quality.traversal;
        if (plan::isRasterised(request.quality)) traversal.reset();
        shader::GlyphLayerParams params = glyphParameters(device, target, target.layers[i], scene, glyphs, traversal, frame);
        params.layer = static_cast<std::uint32_t>(i);
        target.layer(i) = params;
    }
}

}  // namespace radiata::render
