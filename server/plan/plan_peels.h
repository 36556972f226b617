// Transparent layers: which are composed from the front, layer by layer of what lies behind each other, and by which pass.
#pragma once

#include "plan/plan.h"

namespace radiata::plan {

/// Finds out which layers are peeled, and lets the passes that draw their glyphs write surface buffers of their own.
/// Transparent fibres always are; glyphs beside other layers, their nearest ones (alone they mix with the background);
/// isosurfaces beside any of these. Before markFirst(). \throws Error(kUnsupported) for transparent fibres with frozen culling,
/// and for transparent glyphs that show their uncertainty
///         beside other layers
void findPeeled(FramePlan& plan);

/// Adds the pass of all transparent layers, after all that write the surface buffer; isosurfaces alone have one of their own.
void planPeels(FramePlan& plan);

}  // namespace radiata::plan
