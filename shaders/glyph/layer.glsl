// Access to one glyph layer, and the hit of a ray with one of its glyphs. Included by the passes of shaders/glyph.
// Specialisation constants are shared by all of them; what a pass does not use costs it nothing.
#include "shaders/shared/frame.glsl"
#include "shaders/shared/glyph.glsl"
#include "sh_basis.glsl"
#include "circle.glsl"
#include "pole_table.glsl"
#include "shaders/common/camera_rays.glsl"
#include "shaders/common/ray_plane.glsl"
#include "shaders/common/box.glsl"
#include "shaders/common/circle_march.glsl"
#include "shaders/common/pole_frame.glsl"

#ifndef GLYPH_WITHOUT_GROUPS  // fragment shaders
layout(local_size_x_id = 0) in;
#endif
layout(constant_id = 1) const uint kTraversal = 0u;      // 0: compute hierarchy, 1: tile lists (ray queries are modules of their own)
layout(constant_id = 2) const bool kPoleTable = false;   // circles from the pole-frame table instead of from samples
layout(constant_id = 3) const bool kBothLobes = false;   // negative lobes are drawn too
layout(constant_id = 4) const uint kUsed = SH_COUNT;     // coefficients that count; the rest is taken as 0 (band limit)
layout(constant_id = 5) const bool kFirstLayer = true;   // nothing is in the surface buffer yet
layout(constant_id = 6) const bool kBoxesOnly = false;   // for measurements: visit the boxes, intersect nothing
layout(constant_id = 7) const uint kTileShiftX = 2u;     // pixels per tile, log2
layout(constant_id = 8) const uint kTileShiftY = 1u;
// From 9 on: settings of the method of intersection, in the file of that method.

layout(buffer_reference, scalar) readonly buffer FrameBuffer { FrameParams frame; };
layout(buffer_reference, scalar) readonly buffer LayerBuffer { GlyphLayerParams layer; };
layout(buffer_reference, scalar) readonly buffer InstanceBuffer { GlyphInstance at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FloatBuffer { float at[]; };
layout(buffer_reference, scalar) readonly buffer UintBuffer { uint at[]; };
layout(buffer_reference, scalar) readonly buffer RangeBuffer { uvec2 at[]; };
layout(buffer_reference, scalar) buffer SurfaceBuffer { Surface at[]; };
layout(buffer_reference, scalar) buffer CounterBuffer { uint hit_pixels; uint capped_rays; };

float glyph_coefficients[SH_COUNT];
uint loaded_slot = 0xffffffffu;

#ifdef GLYPH_SHARED_READS
#include "shaders/glyph/shared_reads.glsl"
#endif

// Reads are the dear part on CPU drivers, so what is there already is kept: the normal of the glyph that was tried last needs none.
void loadCoefficients(uint64_t coefficients, uint stride, uint slot) {
    if (slot == loaded_slot) return;
    loaded_slot = slot;
    FloatBuffer source = FloatBuffer(coefficients + uint64_t(slot) * uint64_t(stride) * 4ul);
#ifdef GLYPH_SHARED_READS
    if (isShared(slot)) {
        loadSharedCoefficients(source);
        return;
    }
#endif
#define SOURCE(i) source.at[i]
    SH_LOAD(SOURCE, kUsed, glyph_coefficients)
}

// Centre relative to the frame's reference point, mm: the difference of two sums of two floats.
vec3 instanceCentre(CameraRays rays, GlyphInstance instance) {
    return (instance.centre_high - rays.reference_high) + (instance.centre_low - rays.reference_low);
}
