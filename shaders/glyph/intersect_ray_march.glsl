// Hits by marching with steps of equal length, after Peeters et al. 2009 or van Almsick et al. 2011. Both search the part of the ray that is in
// the glyph's box as well as in their own bounding volume. With kPoleTable the coefficients were rotated once for the camera (van_almsick_table.comp),
// else van Almsick's method rotates them for each ray, with the ray's direction as the pole.
#include "van_almsick.glsl"
layout(constant_id = 9) const bool kMarchVanAlmsick = false;  // else Peeters
layout(constant_id = 10) const uint kMarchSteps = 100u;
layout(constant_id = 11) const uint kMarchRefinements = 10u;

float shEvaluate(vec3 direction) { return shEvaluate(glyph_coefficients, direction).x; }
#include "shaders/common/march_peeters.glsl"
#include "shaders/common/march_van_almsick.glsl"

VanAlmsickRay vanAlmsickRayOf(FrameParams frame, GlyphLayerParams layer, uint index, GlyphInstance instance, vec3 centre, RayPlane plane) {
    float g[SH_K + 1];
    if (kPoleTable) {
        FloatBuffer table = FloatBuffer(layer.tables + uint64_t(index) * uint64_t(VAN_ALMSICK_COUNT * 4));
        const PoleCircle circle = poleCircle(poleAxis(frame.rays, centre), ray.direction, plane.e);
        const float ca = circle.azimuth.x, sa = circle.azimuth.y;
#define VAN_ALMSICK_ENTRY(i) table.at[i]
        VAN_ALMSICK_PLANE(VAN_ALMSICK_ENTRY, ca, sa, g)
        return vanAlmsickRay(g, vec2(table.at[VAN_ALMSICK_RADIUS], table.at[VAN_ALMSICK_HALF_LENGTH]), circle.offset, plane);
    }
    loadCoefficients(layer.coefficients, layer.stride, instance.slot);
    float rotated[VAN_ALMSICK_COUNT];
    vanAlmsickTable(glyph_coefficients, -ray.direction, rotated);
    const PoleCircle circle = poleCircle(-ray.direction, ray.direction, plane.e);
    const float ca = circle.azimuth.x, sa = circle.azimuth.y;
#define VAN_ALMSICK_ROTATED(i) rotated[i]
    VAN_ALMSICK_PLANE(VAN_ALMSICK_ROTATED, ca, sa, g)
    return vanAlmsickParallel(g, vec2(rotated[VAN_ALMSICK_RADIUS], rotated[VAN_ALMSICK_HALF_LENGTH]), plane);
}

void intersectInstance(FrameParams frame, GlyphLayerParams layer, uint index, GlyphInstance instance, vec3 centre) {
    const float unit = 1.0 / instance.scale;
    const vec3 origin = (ray.origin - centre) * unit;
    const RayPlane plane = rayPlane(origin, ray.direction);
    const float radius = instance.radius * unit;
    if (plane.h >= radius) return;
    const vec2 box = boxSpan(ray.origin - centre, ray_inverse, instance.box_min, instance.box_max);
    const float half_chord = sqrt((radius - plane.h) * (radius + plane.h));
    const vec2 span = vec2(max(max(box.x, ray.near) * unit, plane.closest - half_chord), min(box.y * unit, plane.closest + half_chord));
    GlyphHit hit;
    if (kMarchVanAlmsick) {
        hit = vanAlmsickFirstHit(vanAlmsickRayOf(frame, layer, index, instance, centre, plane), span, kBothLobes);
    } else {
        loadCoefficients(layer.coefficients, layer.stride, instance.slot);
        hit = peetersFirstHit(origin, ray.direction, span, kBothLobes);
    }
    keepNearest(index, instance.scale, hit, origin);
}
