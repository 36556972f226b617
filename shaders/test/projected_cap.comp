// Runs projected_cap.glsl, cosine_hemisphere.glsl and ray_samples.glsl over an array.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/visibility_io.glsl"
#include "shaders/common/cosine_hemisphere.glsl"
#include "shaders/common/projected_cap.glsl"
#include "shaders/common/ray_samples.glsl"

FUNCTION_OVER(CapInput, CapOutput)

CapOutput function(CapInput x) {
    CapOutput result;
    const ProjectedCap cap = projectedCap(x.light, x.normal, x.sine, x.cosine);
    result.area = cap.area;
    result.point = raySample(x.index, x.pixel);
    result.direction = cap.area > 0.0 ? projectedCapSample(cap, result.point) : vec3(0.0);
    result.hemisphere = cosineHemisphereSample(x.normal, result.point);
    return result;
}

FUNCTION_MAIN
