#include "render/frame/raster_passes.h"

#include <algorithm>
#include <chrono>

#include "plan/raster_view.h"
#include "render/frame/raster_buffers.h"
#include "shaders/shared/raster.glsl"

namespace radiata::render {
namespace {

constexpr double kSubmissionMs = 20;
// What a glyph costs beside its fragments, in pixels: measured on lavapipe, where a marched fragment costs about 1 us.
constexpr double kBoxWork = 4;
constexpr double kVertexWork = 0.5;

struct BoxesPush {
    std::uint64_t frame, layer, view, list, surface, counters, nearest, steps;
};
struct TessellatePush {
    std::uint64_t layer, list, directions, vertices;
    std::uint32_t first, vertex_count;
};
struct MeshPush {
    std::uint64_t frame, layer, view, list, vertices;
    std::uint32_t first, vertex_count;
    std::uint64_t surface;
};
struct SurfacePush {
    std::uint64_t surface, counters, words, depth, steps;
    std::uint32_t pixels, layer;
};

bool drawn(const plan::PassPlan& pass) { return pass.kind == plan::PassKind::kRasterSurface; }

/// Submits and learns from the time how much work the next submission may have.
void submitPart(PassRun& run, DrawSize& size, double work) {
    const auto begin = std::chrono::steady_clock::now();
    run.recorder.submitAndWait();
    const double took_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    size.work = std::clamp(work * std::clamp(kSubmissionMs / std::max(took_ms, 0.01), 0.25, 4.0), 500.0, 1e9);
}

/// Calls draw(part) for all visible glyphs of a layer, submitting after each.
template <typename Draw>
void forEachPart(PassRun& run, const VisibleGlyphs& visible, double work_per_glyph, std::uint32_t count_max, DrawSize& size,
                 Draw&& draw) {
    const auto count = static_cast<std::uint32_t>(visible.order.size());
    std::uint32_t next = 0, row = 0;
    while (next < count) {
        run.checkCancelled();
        const DrawPart part = nextPart(visible, next, row, size.work, work_per_glyph, count_max, run.target.height);
        draw(part);
        submitPart(run, size, part.work);
        row = part.first_row + part.rows;
        if (row < static_cast<std::uint32_t>(run.target.height)) continue;
        row = 0;
        next += part.count;
    }
}

}  // namespace

void prepareRaster(PassRun& run) {
    Target::Impl& target = run.target;
    if (std::ranges::none_of(run.list.plan->passes, drawn)) {
        target.raster.reset();
        return;
    }
    if (!target.raster) target.raster = std::make_unique<RasterBuffers>();
    if (run.sample == 0) target.raster->prepare(run.device, target, run.list);
    target.raster->view.as<shader::RasterView>()[0] =
        plan::rasterView(target.frame().rays, target.width, target.height, target.frame().jitter);
}

void runGlyphBoxes(PassRun& run, const plan::PassPlan& pass, bool boxes_only, DrawSize& size) {
    RasterBuffers& raster = *run.target.raster;
    const auto layer = static_cast<std::size_t>(pass.layer);
    const plan::GlyphPlan& glyphs = run.list.plan->glyphs[layer];
    const RasterLayer& own = raster.layers[layer];
    if (!boxes_only) run.recorder.fill(raster.nearest, 0, run.pixels() * 4, 0xffffffffU);
    run.recorder.fill(raster.steps, 0, run.pixels() * 4, 0);
    run.recorder.clear(raster.images);
    if (own.visible.order.empty() || !run.list.camera.sees_scene) return;
    const gpu::GraphicsPipeline& pipeline =
        run.pipelines.getGraphics("glyph_boxes_vert", pass.shader,
                                  {PassRun::kGroup, 0U, glyphs.pole_table ? 1U : 0U, glyphs.both_lobes ? 1U : 0U, glyphs.used,
                                   pass.first ? 1U : 0U, boxes_only ? 1U : 0U},
                                  gpu::Faces::kBack);
    const BoxesPush push{run.frameAddress(),       run.layerAddress(layer),      raster.view.address(),
                         own.list.address(),       run.target.surface.address(), run.counterAddress(),
                         raster.nearest.address(), raster.steps.address()};
    forEachPart(run, own.visible, kBoxWork, 0xffffffffU, size, [&](const DrawPart& part) {
        run.recorder.draw(pipeline, boxes_only ? "boxes" : pass.name, raster.images,
                          {&raster.box_triangles, 36, part.first, part.count, part.first_row, part.rows}, push);
    });
}

void runGlyphMesh(PassRun& run, const plan::PassPlan& pass, DrawSize& size) {
    const plan::PassPlan& tessellate = *std::ranges::find_if(run.list.plan->passes, [&](const plan::PassPlan& other) {
        return other.kind == plan::PassKind::kGlyphTessellate && other.layer == pass.layer;
    });
    RasterBuffers& raster = *run.target.raster;
    const auto layer = static_cast<std::size_t>(pass.layer);
    const plan::GlyphPlan& glyphs = run.list.plan->glyphs[layer];
    const RasterLayer& own = raster.layers[layer];
    run.recorder.clear(raster.images);
    if (own.visible.order.empty() || !run.list.camera.sees_scene) return;
    const gpu::ComputePipeline& deform =
        run.pipelines.get(tessellate.shader, {PassRun::kGroup, 0U, 0U, glyphs.both_lobes ? 1U : 0U, glyphs.used});
    const bool triangle_normals = run.list.plan->resolved.quality.tessellation.normals == model::MeshNormals::kTriangle;
    const gpu::GraphicsPipeline& pipeline = run.pipelines.getGraphics(
        "glyph_mesh_vert", pass.shader, {0U, pass.first ? 1U : 0U, triangle_normals ? 1U : 0U}, gpu::Faces::kAll);
    const std::uint64_t glyph_bytes = std::uint64_t{raster.vertex_count} * sizeof(shader::MeshVertex);
    // Rows of workgroups are limited too: every device takes 65,535.
    const auto count_max = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(kVertexBytes / glyph_bytes, 1, 65'535));
    forEachPart(run, own.visible, kVertexWork * raster.vertex_count, count_max, size, [&](const DrawPart& part) {
        const std::uint64_t vertices = own.vertices.address() + (own.keeps_all ? part.first * glyph_bytes : 0);
        // Later samples find a layer that was kept whole; further bands of a glyph find the glyph.
        if (part.first_row == 0 && (run.sample == 0 || !own.keeps_all)) {
            run.recorder.dispatch(deform, tessellate.name, PassRun::groups(raster.vertex_count), part.count, 1,
                                  TessellatePush{run.layerAddress(layer), own.list.address(), raster.directions.address(),
                                                 vertices, part.first, raster.vertex_count});
        }
        run.recorder.draw(pipeline, pass.name, raster.images,
                          {&raster.mesh_triangles, raster.index_count, 0, part.count, part.first_row, part.rows},
                          MeshPush{run.frameAddress(), run.layerAddress(layer), raster.view.address(), own.list.address(),
                                   vertices, part.first, raster.vertex_count, run.target.surface.address()});
    });
}

void runRasterSurface(PassRun& run, const plan::PassPlan& pass) {
    RasterBuffers& raster = *run.target.raster;
    // Of boxes the depth says where the ray was; triangles of isosurfaces tell it themselves.
    const bool boxes = raster.steps && run.list.layers[static_cast<std::size_t>(pass.layer)].glyphs != nullptr;
    run.recorder.copy(raster.images, raster.words, raster.depth);
    run.recorder.dispatch(run.pipelines.get(pass.shader, {PassRun::kGroup, pass.first ? 1U : 0U, boxes ? 1U : 0U}), pass.name,
                          PassRun::groups(run.pixels()), 1, 1,
                          SurfacePush{run.target.surface.address(), run.counterAddress(), raster.words.address(),
                                      raster.depth.address(), boxes ? raster.steps.address() : 0,
                                      static_cast<std::uint32_t>(run.pixels()), static_cast<std::uint32_t>(pass.layer)});
}

}  // namespace radiata::render
