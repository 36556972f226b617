// Isosurface layers drawn as triangles, to compare with tracing.
#pragma once

#include "render/frame/pass_run.h"

namespace radiata::render {

/// Pieces of triangles per submission, adapted to the last measured speed.
struct TrianglePace {
    double pieces = 1;
};

/// First hits of one layer by its triangles into the raster images.
void runIsosurfaceMesh(PassRun& run, const plan::PassPlan& pass, TrianglePace& pace);

}  // namespace radiata::render
