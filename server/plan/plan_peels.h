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

/// Segments that each pixel keeps of a layer of transparent fibres, so that they need not be drawn for each that is composed:
/// a power of two up to `wanted`, as many as fit 256 MiB for all such layers. \param layers  of transparent fibres
std::uint32_t peelSlots(std::uint64_t pixels, std::uint64_t layers, std::uint32_t wanted);

}  // namespace radiata::plan
