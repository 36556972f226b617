// What every pass of a frame reads: camera rays, picture, light. Source of the rebasing: docs/architecture.md, "One frame".
#ifndef RADIATA_SHARED_FRAME
#define RADIATA_SHARED_FRAME
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

// Pixel rays, relative to the reference point, which lies on the line of sight inside the scene. All positions are mm.
// The ray of picture point (px, py), in pixels from the centre, right and up: it passes through
//   origin = px * step_right + py * step_up  (on the plane through the reference point, orthogonal to the line of sight)
// in direction forward (orthographic) or normalize(origin * inverse_distance + forward) (perspective), t measured from there.
struct CameraRays {
    vec3 step_right;
    float inverse_distance;  // 1 / distance from the eye to the reference plane; 0: orthographic
    vec3 step_up;
    float near_depth;  // along forward, from the reference plane; in front of the scene or at the near clip plane
    vec3 forward;
    float far_depth;
    vec3 scene_from_reference;  // what to add to a rebased position to get scene coordinates (those of the boxes)
    float pad;
    vec3 reference_high;  // reference point minus scene centre, as a sum of two floats
    float pad2;
    vec3 reference_low;
    float pad3;
};
STATIC_SIZE(CameraRays, 96);

struct FrameParams {
    CameraRays rays;
    uint width;
    uint height;
    vec2 jitter;  // of this sample, pixels
    vec3 light_direction;  // world axes, unit, towards the light
    float irradiance;
    vec3 background;  // linear
    float ambient;
    uint sample_index;
    uint layer_count;
    uint tiles_x;
    uint tiles_y;
    float light_sine;  // of the angular radius of the light of soft shadows
    float light_cosine;
    float occlusion_radius;  // mm
    vec3 sun_right;          // tiles per mm across the light's direction, for lists of boxes along it; see sunTile
    uint sun_tiles_x;
    vec3 sun_up;
    uint sun_tiles_y;
};
STATIC_SIZE(FrameParams, 204);

// One per pixel: what the layers share. 24 bytes.
struct Surface {
    float depth;   // ray parameter t, mm; +inf: nothing
    uint who;      // glyph instance of its layer; 0xffffffff: nothing, and the normal is not set
    vec3 normal;   // world, unit, towards the viewer
    uint layer_and_steps;  // layer << 24 | march steps over all glyphs tried
};
STATIC_SIZE(Surface, 24);

SHADER_NAMESPACE_END
#endif
