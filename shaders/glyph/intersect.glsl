// The nearest hit of a pixel's ray so far, and the test of one more glyph against it.
// A METHOD_ definition selects one of the comparison methods, or ellipsoids, in place of the march; each has a file.
#include "shaders/common/glyph_hit.glsl"

PixelRay ray;
vec3 ray_inverse;
float best_t;
uint best_instance;
vec3 best_direction;  // from the glyph's centre to the hit
uint total_steps = 0u;
uint capped_rays = 0u;

// a cos(h (theta)) with theta = phi - offset, so the coefficient pair turns by +offset; see poleCircleShift.
void instanceCircle(FrameParams frame, GlyphLayerParams layer, uint index, GlyphInstance instance, vec3 centre, RayPlane plane,
                    out vec2 F[CIRCLE_HARMONICS + 1]) {
    if (kPoleTable) {
        const PoleCircle circle = poleCircle(poleAxis(frame.rays, centre), ray.direction, plane.e);
        FloatBuffer table = FloatBuffer(layer.tables + uint64_t(index) * uint64_t(POLE_TABLE_COUNT * 4));
        const float ca = circle.azimuth.x, sa = circle.azimuth.y;
#define TABLE_ENTRY(i) table.at[i]
        POLE_TABLE_FOURIER(TABLE_ENTRY, ca, sa, F)
        poleCircleShift(F, circle.offset);
    } else {
        loadCoefficients(layer.coefficients, layer.stride, instance.slot);
        circleFourier(glyph_coefficients, ray.direction, plane.e, F);
    }
}

#if defined METHOD_POLYNOMIAL || defined METHOD_LAGUERRE || defined METHOD_RAY_MARCH
// Makes a hit the nearest so far if it is nearer, or as near and of a lower instance, so that every traversal gives the same picture.
// \param origin  of the ray relative to the glyph's centre, in units of amplitude
void keepNearest(uint index, float scale, GlyphHit hit, vec3 origin) {
    total_steps += hit.steps;
    const float t = hit.t * scale;
    if (hit.amplitude != 0.0 && (t < best_t || (t == best_t && index < best_instance))) {
        best_t = t;
        best_instance = index;
        best_direction = normalize(origin + hit.t * ray.direction);
    }
}
#endif

#if defined METHOD_TENSOR
#include "shaders/glyph/intersect_tensor.glsl"
#elif defined METHOD_ELLIPSOID
#include "shaders/glyph/intersect_ellipsoid.glsl"
#elif defined METHOD_POLYNOMIAL || defined METHOD_LAGUERRE
#include "shaders/glyph/intersect_polynomial.glsl"
#elif defined METHOD_RAY_MARCH
#include "shaders/glyph/intersect_ray_march.glsl"
#else
void intersectInstance(FrameParams frame, GlyphLayerParams layer, uint index, GlyphInstance instance, vec3 centre) {
    const float unit = 1.0 / instance.scale;
    const RayPlane plane = rayPlane((ray.origin - centre) * unit, ray.direction);
    const float radius = instance.radius * unit;
    if (plane.h >= radius) return;
    vec2 F[CIRCLE_HARMONICS + 1];
    instanceCircle(frame, layer, index, instance, centre, plane, F);
    const vec2 start = circleStart(plane.closest, plane.h, ray.near * unit);
    const CircleHit hit = circleMarch(F, plane.h, radius, start, kBothLobes);
    total_steps += hit.steps;
    capped_rays += hit.capped ? 1u : 0u;
    const float t = circleHitParameter(hit, plane.h, plane.closest) * instance.scale;
    if (circleHitCounts(hit, t, ray.near, instance.radius) && (t < best_t || (t == best_t && index < best_instance))) {
        best_t = t;
        best_instance = index;
        best_direction = hit.angle.y * plane.e - hit.angle.x * ray.direction;
    }
}
#endif

// The glyph whose box was entered last; kept from the test of its box to the test of the glyph, as reads are dear.
GlyphInstance candidate;
vec3 candidate_centre;

// Box first, glyph after. \return whether the box was entered before the nearest hit
bool visitInstance(FrameParams frame, GlyphLayerParams layer, uint index) {
#ifdef GLYPH_SHARED_READS
    if (isShared(index)) candidate = sharedInstance(layer.instances, index);
    else
#endif
        candidate = InstanceBuffer(layer.instances).at[index];
    candidate_centre = instanceCentre(frame.rays, candidate);
    const vec2 span = boxSpan(ray.origin - candidate_centre, ray_inverse, candidate.box_min, candidate.box_max);
    return span.x <= span.y && span.x < best_t && span.y >= ray.near;
}
