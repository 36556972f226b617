// Runs brdf.glsl, phong.glsl, illuminated_line.glsl and srgb.glsl over an array.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/shading_io.glsl"
#include "shaders/common/brdf.glsl"
#include "shaders/common/illuminated_line.glsl"
#include "shaders/common/phong.glsl"
#include "shaders/common/srgb.glsl"

FUNCTION_OVER(ShadingInput, ShadingOutput)

ShadingOutput function(ShadingInput x) {
    ShadingOutput result;
    result.radiance = shadeDielectric(x.base, x.roughness, x.normal, x.viewer, x.light, x.irradiance, x.ambient);
    result.srgb = srgbFromLinear(x.base);
    result.linear = linearFromSrgb(x.base);
    result.line = illuminatedLine(x.base, x.roughness, x.normal, x.viewer, x.light);
    result.phong = phongReflection(x.base, x.normal, x.viewer, x.light);
    result.lambert = lambertReflection(x.base, x.normal, x.light);
    result.ambient = varyingAmbient(x.normal, x.light);
    return result;
}

FUNCTION_MAIN
