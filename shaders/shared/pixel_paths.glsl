// What path tracing keeps of a pixel while it goes on.
#ifndef RADIATA_SHARED_PIXEL_PATHS
#define RADIATA_SHARED_PIXEL_PATHS
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

// Of the pixel's point: irradiance over all paths so far, bounces weighted by the albedo; its relative standard error at the end of
// the latest stage; and the luminance of each of four independent replicates.
struct PixelPaths {
    vec3 sum;
    float relative_error;  // below 0: no surface here
    vec4 replicates;
    uint count;            // of paths of each replicate
};
STATIC_SIZE(PixelPaths, 36);

SHADER_NAMESPACE_END
#endif
