// The passes of a glyph layer: its pole-frame tables, and the first hits along the pixels' rays.
#pragma once

#include "render/frame/pass_run.h"

namespace radiata::render {

/// One table per glyph, for the camera of the first sample; the others use it again.
void runGlyphTable(PassRun& run, const plan::PassPlan& pass);

/// First hits of one layer into the surface buffer.
/// \param boxes_only  runs the traversal over the finished surface buffer once more, intersecting nothing, timed as "boxes"
void runGlyphTrace(PassRun& run, const plan::PassPlan& pass, bool boxes_only, BandSize& bands);

}  // namespace radiata::render
