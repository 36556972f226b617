#include "render/frame/glyph_passes.h"

#include "plan/tensor_methods.h"
#include "render/frame/frame_parameters.h"

namespace radiata::render {
namespace {

struct TablePush {
    std::uint64_t frame, layer;
};
struct TracePush {
    std::uint64_t frame, layer, surface, counters;
    std::uint32_t first_block_row;
};

}  // namespace

void runGlyphTable(PassRun& run, const plan::PassPlan& pass) {
    const auto layer = static_cast<std::size_t>(pass.layer);
    const std::uint32_t count = run.target.layer(layer).count;
    if (run.sample > 0 || count == 0) return;
    const std::uint32_t used = run.list.plan->glyphs[layer].used;
    run.recorder.dispatch(run.pipelines.get(pass.shader, {PassRun::kGroup, 0U, 0U, 0U, used}), pass.name,
                          PassRun::groups(count), 1, 1, TablePush{run.frameAddress(), run.layerAddress(layer)});
}

void runGlyphTrace(PassRun& run, const plan::PassPlan& pass, bool boxes_only, BandSize& bands) {
    const auto layer = static_cast<std::size_t>(pass.layer);
    const plan::GlyphPlan& glyphs = run.list.plan->glyphs[layer];
    const model::Quality& quality = run.list.plan->resolved.quality;
    const bool tiles = quality.traversal == model::Traversal::kTiles;
    GlyphScene& scene = *run.list.layers[layer].glyphs;
    const bool empty = scene.instances().empty();
    // A ray query needs a structure, which an empty layer has not: its rays walk the empty hierarchy instead.
    std::string shader = pass.shader;
    if (empty && shader.find("query_") != std::string::npos) shader.replace(shader.find("query_"), 6, "trace_");
    shader::GlyphLayerParams& params = run.target.layer(layer);
    if (empty && params.bvh_nodes == 0 && !tiles) {
        params.bvh_nodes = scene.bvhNodes().address();
        params.bvh_order = scene.bvhOrder().address();
    }
    std::vector<std::uint32_t> constants = {PassRun::kGroup,
                                            tiles ? 1U : 0U,
                                            glyphs.pole_table && !empty ? 1U : 0U,
                                            glyphs.both_lobes ? 1U : 0U,
                                            glyphs.used,
                                            pass.first ? 1U : 0U,
                                            boxes_only ? 1U : 0U,
                                            kTileShiftX,
                                            kTileShiftY};
    constants.insert(constants.end(), glyphs.method_constants.begin(), glyphs.method_constants.end());
    const gpu::ComputePipeline& pipeline = run.pipelines.get(shader, constants);
    run.dispatchBands(
        pipeline, boxes_only ? "boxes" : pass.name,
        TracePush{run.frameAddress(), run.layerAddress(layer), run.target.surface.address(), run.counterAddress(), 0}, bands);
}

}  // namespace radiata::render
