#include "render/frame/drawer.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "build/tile_lists.h"
#include "gpu/device.h"

namespace radiata::render {
namespace {

constexpr std::uint32_t kGroup = 64;  // invocations per workgroup: a block of 8x8 pixels
constexpr std::size_t kTileEntriesMax = 24'000'000;

struct TracePush {
    std::uint64_t frame, layer, surface, counters;
    std::uint32_t first_block_row;
};
struct TablePush {
    std::uint64_t frame, layer;
};
struct LightPush {
    std::uint64_t frame, surface, light, looks;
};
struct ResolvePush {
    std::uint64_t light, picture;
    std::uint32_t pixels, samples;
};

std::uint32_t groups(std::uint64_t count) { return static_cast<std::uint32_t>((count + kGroup - 1) / kGroup); }

/// Sample positions within the pixel: the centre first, then the R2 sequence (Roberts 2018), which fills the square evenly.
glm::vec2 jitterOf(int sample) {
    if (sample == 0) return glm::vec2(0);
    const double x = 0.5 + 0.7548776662466927 * sample, y = 0.5 + 0.5698402909980532 * sample;
    return {static_cast<float>(x - std::floor(x) - 0.5), static_cast<float>(y - std::floor(y) - 0.5)};
}

void checkCancelled(const std::atomic<bool>* cancel) {
    if (cancel != nullptr && cancel->load()) throw Error(Code::kCancelled, "the picture is no longer wanted");
}

}  // namespace

Drawer::Drawer(gpu::Device& device) : device_(device), recorder_(device), pipelines_(device), colour_tables_(device) {}

void Drawer::prepareCamera(Target::Impl& target, const DrawList& list) {
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
    const bool tiles = request.quality.traversal == model::Traversal::kTiles;
    for (std::size_t i = 0; i < list.layers.size(); ++i) {
        GlyphScene& scene = *list.layers[i];
        const plan::GlyphPlan& glyphs = list.plan->glyphs[i];
        shader::GlyphLayerParams params{};
        params.instances = scene.instanceBuffer().address();
        params.coefficients = scene.dataset().coefficients().address();
        params.count = static_cast<std::uint32_t>(scene.instances().size());
        params.stride = static_cast<std::uint32_t>(scene.dataset().image().layout.count());
        params.used = glyphs.used;
        params.both_lobes = glyphs.both_lobes ? 1 : 0;
        params.layer = static_cast<std::uint32_t>(i);
        LayerBuffers& buffers = target.layers[i];
        if (tiles) {
            const TileLists lists = buildTileLists(scene.instances(), frame.rays, target.width, target.height, kTileShiftX,
                                                   kTileShiftY, kTileEntriesMax);
            if (!lists.complete) {
                throw Error(Code::kResourceExhausted, "quality.traversal tiles: this view needs more than " +
                                                          std::to_string(kTileEntriesMax) + " list entries; use auto or bvh");
            }
            ensureBytes(device_, buffers.tile_ranges, std::span(lists.ranges).size_bytes(), gpu::Memory::kUpload,
                        "tile ranges");
            ensureBytes(device_, buffers.tile_entries, std::max<std::size_t>(std::span(lists.entries).size_bytes(), 4),
                        gpu::Memory::kUpload, "tile entries");
            std::copy(lists.ranges.begin(), lists.ranges.end(), buffers.tile_ranges.as<glm::uvec2>().begin());
            std::copy(lists.entries.begin(), lists.entries.end(), buffers.tile_entries.as<std::uint32_t>().begin());
            params.tile_ranges = buffers.tile_ranges.address();
            params.tile_lists = buffers.tile_entries.address();
            frame.tiles_x = static_cast<std::uint32_t>(lists.tiles_x);
            frame.tiles_y = static_cast<std::uint32_t>(lists.tiles_y);
        } else if (request.quality.traversal == model::Traversal::kRayQuery && !scene.instances().empty()) {
            params.acceleration = scene.acceleration().address();
        } else {
            params.bvh_nodes = scene.bvhNodes().address();
            params.bvh_order = scene.bvhOrder().address();
        }
        if (glyphs.pole_table && params.count > 0) {
            const int k = std::stoi(glyphs.layout_name.substr(4));
            const bool full = glyphs.layout_name.starts_with("full");
            ensureBytes(device_, buffers.table, std::uint64_t{params.count} * poleTableCount(k, full) * 4, gpu::Memory::kDevice,
                        "pole-frame tables");
            params.tables = buffers.table.address();
        }
        target.layer(i) = params;
        target.look(i) = layerLook(list, i);
    }
}

shader::LayerLook Drawer::layerLook(const DrawList& list, std::size_t layer) {
    GlyphScene& scene = *list.layers[layer];
    const model::Layer& wanted = list.plan->resolved.scene.layers[layer];
    const model::GlyphColour& colour = wanted.glyphs.colour;
    shader::LayerLook look{};
    look.instances = scene.instanceBuffer().address();
    look.opacity = wanted.opacity;
    look.colour = static_cast<std::uint32_t>(colour.mode);
    look.uniform_colour = colour.uniform;
    if (!colour.usesMap()) return look;
    look.map = colour_tables_.address(colour.map);
    look.range_low = colour.range->low;
    look.range_high = colour.range->high;
    if (colour.mode == model::ColourMode::kScalar) look.values = scene.values(list.scalars[layer]).address();
    return look;
}

void Drawer::trace(Target::Impl& target, const DrawList& list, std::size_t layer, bool boxes_only,
                   const std::atomic<bool>* cancel) {
    const plan::GlyphPlan& glyphs = list.plan->glyphs[layer];
    const plan::PassPlan* pass = nullptr;
    for (const plan::PassPlan& candidate : list.plan->passes) {
        if (candidate.layer == static_cast<int>(layer) && candidate.name.starts_with("glyph trace")) pass = &candidate;
    }
    const bool tiles = list.plan->resolved.quality.traversal == model::Traversal::kTiles;
    const bool empty = list.layers[layer]->instances().empty();
    // A ray query needs a structure, which an empty layer has not: its rays walk the empty hierarchy instead.
    std::string shader = pass->shader;
    if (empty && shader.find("query_") != std::string::npos) shader.replace(shader.find("query_"), 6, "trace_");
    if (empty && target.layer(layer).bvh_nodes == 0 && !tiles) {
        target.layer(layer).bvh_nodes = list.layers[layer]->bvhNodes().address();
        target.layer(layer).bvh_order = list.layers[layer]->bvhOrder().address();
    }
    const gpu::ComputePipeline& pipeline =
        pipelines_.get(shader, {kGroup, tiles ? 1U : 0U, glyphs.pole_table && !empty ? 1U : 0U, glyphs.both_lobes ? 1U : 0U,
                                glyphs.used, layer == 0 ? 1U : 0U, boxes_only ? 1U : 0U, kTileShiftX, kTileShiftY,
                                list.plan->resolved.quality.polynomial_bracket_stop ? 1U : 0U});
    const std::uint32_t blocks_x = static_cast<std::uint32_t>(target.width + 7) / 8;
    const std::uint32_t blocks_y = static_cast<std::uint32_t>(target.height + 7) / 8;
    const std::uint64_t base = target.params.address();
    for (std::uint32_t row = 0; row < blocks_y;) {
        checkCancelled(cancel);
        const auto rows = std::clamp(static_cast<std::uint32_t>(rows_per_submission_), 1U, blocks_y - row);
        recorder_.dispatch(pipeline, boxes_only ? "boxes" : pass->name, blocks_x, rows, 1,
                           TracePush{base, base + Target::Impl::kLayerOffset + layer * sizeof(shader::GlyphLayerParams),
                                     target.surface.address(), base + Target::Impl::kCounterOffset, row});
        const auto begin = std::chrono::steady_clock::now();
        recorder_.submitAndWait();
        const double took_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
        row += rows;
        rows_per_submission_ = std::clamp(rows * std::clamp(kSubmissionMs / std::max(took_ms, 0.01), 0.25, 4.0), 1.0, 1e6);
    }
}

void Drawer::drawSample(Target::Impl& target, const DrawList& list, int sample, const std::atomic<bool>* cancel) {
    try {
        if (sample == 0) {
            target.samples = 0;
            prepareCamera(target, list);
            target.counters() = Counters{};
        }
        shader::FrameParams& frame = target.frame();
        frame.jitter = jitterOf(sample);
        frame.sample_index = static_cast<std::uint32_t>(sample);
        const std::uint64_t base = target.params.address();
        for (const plan::PassPlan& pass : list.plan->passes) {
            const auto layer = static_cast<std::size_t>(std::max(pass.layer, 0));
            if (pass.name.starts_with("glyph table") && sample == 0 && target.layer(layer).count > 0) {
                const plan::GlyphPlan& glyphs = list.plan->glyphs[layer];
                recorder_.dispatch(
                    pipelines_.get(pass.shader, {kGroup, 0U, 0U, 0U, glyphs.used}), pass.name,
                    groups(target.layer(layer).count), 1, 1,
                    TablePush{base, base + Target::Impl::kLayerOffset + layer * sizeof(shader::GlyphLayerParams)});
            }
            if (pass.name.starts_with("glyph trace")) trace(target, list, layer, false, cancel);
            if (pass.name == "light") {
                recorder_.dispatch(
                    pipelines_.get(pass.shader, {kGroup, sample == 0 ? 1U : 0U, list.plan->colour_modes}), pass.name,
                    groups(static_cast<std::uint64_t>(target.width) * target.height), 1, 1,
                    LightPush{base, target.surface.address(), target.light.address(), base + Target::Impl::kLookOffset});
            }
        }
        recorder_.submitAndWait();
        target.samples = sample + 1;
    } catch (...) {
        recorder_.discard();
        target.samples = 0;
        throw;
    }
}

void Drawer::resolve(Target::Impl& target) {
    const auto pixels = static_cast<std::uint32_t>(static_cast<std::uint64_t>(target.width) * target.height);
    recorder_.dispatch(
        pipelines_.get("resolve", {kGroup}), "resolve", groups(pixels), 1, 1,
        ResolvePush{target.light.address(), target.picture.address(), pixels, static_cast<std::uint32_t>(target.samples)});
    recorder_.submitAndWait();
}

void Drawer::drawBoxes(Target::Impl& target, const DrawList& list) {
    for (std::size_t i = 0; i < list.layers.size(); ++i) trace(target, list, i, true, nullptr);
}

}  // namespace radiata::render
