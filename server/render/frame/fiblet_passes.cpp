#include "render/frame/fiblet_passes.h"

#include "render/frame/fiblet_coverage.h"
#include "render/frame/fiblet_draw.h"

namespace radiata::render {
namespace {

void forgetVisible(FibletRun& layer) {
    layer.run.recorder.fill(layer.own.visible, 0, layer.own.visible.sizeBytes() / 4 * 4, 0);
}

/// Lets `visible` be what is seen from the frozen camera.
void freeze(FibletRun& layer, FibletDraw& drawing) {
    const plan::RebasedCamera& camera = *layer.run.list.frozen;
    layer.own.knows_visible = false;
    layer.prepare(camera.rays, camera.reference_mm);
    drawing.begin(true);
    if (camera.sees_scene) drawing.drawCulled();
    forgetVisible(layer);
    drawing.raster().resolve({.marks = true, .marks_only = true});
}

/// What the next picture is culled by.
void remember(FibletRun& layer, FibletDraw& drawing) {
    if (!layer.byCoverage()) {
        layer.own.coverage.reset();
    } else if (layer.own.coverage && !layer.run.list.frozen) {
        drawing.cull().pyramid();
        layer.own.coverage->remember(layer);
        layer.submit(0);
    }
}

}  // namespace

void runFiblets(PassRun& run, const plan::PassPlan& pass, FibletPace& pace) {
    FibletRun layer(run, static_cast<std::size_t>(pass.layer), pass.first, pace);
    FibletDraw drawing(layer);
    if (run.list.frozen) freeze(layer, drawing);
    layer.prepare(run.target.frame().rays, run.list.camera.reference_mm);
    drawing.begin(layer.first);
    drawing.draw();
    const bool marks = layer.inTwoPhases() && !run.list.frozen && !layer.plan.paged;
    if (marks) forgetVisible(layer);
    drawing.settle({.marks = marks, .counts = true});
    layer.own.knows_visible = marks;
    remember(layer, drawing);
}

}  // namespace radiata::render
