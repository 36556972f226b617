// Glyph layers drawn as triangles: boxes with one march per fragment, or deformed spheres.
#pragma once

#include "render/frame/pass_run.h"

namespace radiata::render {

/// Work per submission in pixels, adapted to the last measured speed so that each takes about kSubmissionMs.
struct DrawSize {
    double work = 20'000;
};

/// Makes, or frees, what drawing needs, and sets the projection of this sample. Before the passes of a sample.
void prepareRaster(PassRun& run);

/// First hits of one layer by its boxes into the raster images.
/// \param boxes_only  visits the boxes, intersects nothing, timed as "boxes"
void runGlyphBoxes(PassRun& run, const plan::PassPlan& pass, bool boxes_only, DrawSize& size);

/// Deforms and draws the spheres of one layer, part by part: this pass and the layer's kGlyphTessellate.
void runGlyphMesh(PassRun& run, const plan::PassPlan& pass, DrawSize& size);

/// From the raster images to the surface buffer.
void runRasterSurface(PassRun& run, const plan::PassPlan& pass);

}  // namespace radiata::render
