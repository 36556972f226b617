// Which of a pixel's secondary rays meet a glyph of one layer: one invocation per pixel, one bit per ray. Several layers add their bits.
// Rays go from the shaded point towards the light's centre (hard shadow), towards a spherical light (soft) or to everywhere above the
// surface (ambient occlusion). All rays of a point that may meet a glyph share one pole frame of that glyph, built once for them.
// Sources: Peters et al. 2023, Sec. 4.3 (shadow rays); shaders/common/projected_cap.glsl, glyph_occlusion.glsl.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/glyph/layer.glsl"
#include "shaders/common/glyph_occlusion.glsl"

const uint kHardRays = 0u, kSoftRays = 1u, kAmbientRays = 2u;
layout(constant_id = 20) const uint kRays = 0u;
layout(constant_id = 21) const bool kSunTable = false;    // hard: circles from the table for the light's direction
layout(constant_id = 22) const bool kFirstCaster = true;  // no layer has written bits yet
layout(constant_id = 23) const uint kRayCount = 1u;       // 1 to 32
layout(constant_id = 24) const bool kSunTiles = false;     // hard: boxes from the lists along the light's direction
#include "shaders/common/secondary_rays.glsl"
#include "shaders/glyph/occluders.glsl"

layout(buffer_reference, scalar) buffer BitBuffer { uint at[]; };

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    LayerBuffer layer;
    SurfaceBuffer surface;
    CounterBuffer counters;
    BitBuffer blocked;
    uint first_block_row;  // of this dispatch, in blocks of 8x8 pixels
} push;

uint capped_rays = 0u;

// Those of the rays that pass the glyph's box.
uint raysThroughBox(uint rays, vec3 origin, GlyphInstance instance, float t_max) {
    uint through = 0u;
    for (uint i = 0u; i < kRayCount; ++i) {
        const vec2 span = boxSpan(origin, inverseDirection(directions[i]), instance.box_min, instance.box_max);
        through |= span.x <= span.y && span.y >= 0.0 && span.x < t_max ? 1u << i : 0u;
    }
    return rays & through;
}

bool raySunBlocked(GlyphLayerParams layer, uint index, GlyphInstance instance, vec3 origin, bool own) {
    const RayPlane plane = rayPlane(origin, directions[0]);
    vec2 F[CIRCLE_HARMONICS + 1];
    if (kSunTable) {
        const PoleCircle circle = poleCircle(-directions[0], directions[0], plane.e);
        FloatBuffer table = FloatBuffer(layer.sun_tables + uint64_t(index) * uint64_t(POLE_TABLE_COUNT * 4));
        const float ca = circle.azimuth.x, sa = circle.azimuth.y;
#define SUN_ENTRY(i) table.at[i]
        POLE_TABLE_FOURIER(SUN_ENTRY, ca, sa, F)
    } else {
        loadCoefficients(layer.coefficients, layer.stride, instance.slot);
        circleFourier(glyph_coefficients, directions[0], plane.e, F);
    }
    const CircleOcclusion hit = glyphOcclusion(F, plane, instance.radius / instance.scale, 1e30, own, kBothLobes);
    capped_rays += hit.capped ? 1u : 0u;
    return hit.blocked;
}

// Those of the rays that the glyph blocks; through the pole frame of their common origin.
uint raysBlocked(GlyphLayerParams layer, GlyphInstance instance, vec3 origin, bool own, uint rays, float t_max) {
    loadCoefficients(layer.coefficients, layer.stride, instance.slot);
    const vec3 axis = originAxis(origin);
    float table[POLE_TABLE_COUNT];
    poleTableBuild(glyph_coefficients, axis, table);
    uint blocked = 0u;
    while (rays != 0u) {
        const int i = findLSB(rays);
        rays &= rays - 1u;
        const vec3 direction = directions[i];
        const RayPlane plane = rayPlane(origin, direction);
        const PoleCircle circle = poleCircle(axis, direction, plane.e);
        const float ca = circle.azimuth.x, sa = circle.azimuth.y;
        vec2 F[CIRCLE_HARMONICS + 1];
#define ORIGIN_ENTRY(i) table[i]
        POLE_TABLE_FOURIER(ORIGIN_ENTRY, ca, sa, F)
        poleCircleShift(F, circle.offset);
        const CircleOcclusion hit = glyphOcclusion(F, plane, instance.radius / instance.scale, t_max, own, kBothLobes);
        capped_rays += hit.capped ? 1u : 0u;
        blocked |= hit.blocked ? 1u << i : 0u;
    }
    return blocked;
}

void main() {
    const FrameParams frame = push.frame.frame;
    const GlyphLayerParams layer = push.layer.layer;
    const uvec2 pixel = pixelOfInvocation(push.first_block_row);
    if (pixel.x >= frame.width || pixel.y >= frame.height) return;
    const uint at = pixel.y * frame.width + pixel.x;
    const Surface surface = push.surface.at[at];
    if (surface.who == 0xffffffffu) return;
    uint rays = makeRays(frame, surface.normal, at);
    uint blocked = kFirstCaster ? 0u : push.blocked.at[at];
    rays &= ~blocked;

    const PixelRay ray = pixelRay(frame.rays, vec2(frame.width, frame.height), vec2(pixel) + 0.5 + frame.jitter);
    const vec3 point = ray.origin + surface.depth * ray.direction;
    RayBundle bundle;
    bundle.origin = point + frame.rays.scene_from_reference;
    bundle.axis = frame.light_direction;
    bundle.inverse = inverseDirection(frame.light_direction);
    bundle.sine = frame.light_sine;
    bundle.cosine = frame.light_cosine;
    bundle.normal = surface.normal;
    bundle.radius = frame.occlusion_radius;
    const float t_max = kRays == kAmbientRays ? frame.occlusion_radius : 1e30;
    NodeBuffer nodes = NodeBuffer(layer.bvh_nodes);
    UintBuffer order = UintBuffer(layer.bvh_order);
    const uint own = surface.layer_and_steps >> 24u == layer.layer ? surface.who : 0xffffffffu;

    BundleWalk walk;
    if (kSunTiles) walk = beginList(frame, RangeBuffer(layer.sun_ranges), point);
    else walk = beginWalk();
    while (walk.more && rays != 0u) {
        // First find, then march: so that the march is run together by as many invocations as have found something.
        uint found = 0xffffffffu, through = 0u;
        GlyphInstance instance;
        vec3 origin;
        while (walk.more && through == 0u) {
            found = kSunTiles ? nextOfList(walk, UintBuffer(layer.sun_lists)) : nextOccluder(walk, bundle, nodes, order);
            if (found != 0xffffffffu) {
                instance = InstanceBuffer(layer.instances).at[found];
                origin = point - instanceCentre(frame.rays, instance);
                through = found == own ? rays : raysThroughBox(rays, origin, instance, t_max);
            }
        }
        if (through != 0u) {
            const vec3 scaled = origin / instance.scale;
            uint hit;
            if (kRays == kHardRays) hit = raySunBlocked(layer, found, instance, scaled, found == own) ? 1u : 0u;
            else hit = raysBlocked(layer, instance, scaled, found == own, through, t_max >= 1e30 ? t_max : t_max / instance.scale);
            blocked |= hit;
            rays &= ~hit;
        }
    }
    push.blocked.at[at] = blocked;
    if (capped_rays > 0u) atomicAdd(push.counters.capped_rays, capped_rays);
}
