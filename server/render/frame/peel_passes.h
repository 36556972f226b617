// Composes all transparent layers of a scene into the veil, which the light pass puts before what is opaque.
#pragma once

#include "render/frame/fiblet_run.h"

namespace radiata::render {

/// Runs a pass that draws glyphs of a transparent layer (plan::PassPlan::peeled) with the layer's own surface buffer in place
/// of the target's.
template <typename Draw>
void runPeeled(PassRun& run, const plan::PassPlan& pass, Draw&& draw);

/// A surface buffer of its own for each layer whose glyphs are peeled.
gpu::Buffer& peelGlyphs(PassRun& run, std::size_t layer);

/// From the front, one surface per pixel and round, the nearest of all layers, until less than 1/512 of what lies behind is
/// seen. Of a moving picture (DrawList::moving) four rounds, the last of which stands for all behind it, with the right
/// transparency.
void runPeels(PassRun& run, const plan::PassPlan& pass, FibletPace& pace, BandSize& bands);

template <typename Draw>
void runPeeled(PassRun& run, const plan::PassPlan& pass, Draw&& draw) {
    gpu::Buffer& own = peelGlyphs(run, static_cast<std::size_t>(pass.layer));
    // A pixel that shows transparent glyphs only is no hit, as with transparent layers of other kinds.
    run.recorder.submitAndWait();
    const std::uint32_t hits = run.target.counters().hit_pixels;
    std::swap(run.target.surface, own);
    try {
        draw();
        run.recorder.submitAndWait();
    } catch (...) {
        std::swap(run.target.surface, own);
        throw;
    }
    std::swap(run.target.surface, own);
    run.target.counters().hit_pixels = hits;
}

}  // namespace radiata::render
