// The transfer curve of sRGB (IEC 61966-2-1). Twin: server/reference/shading.
#ifndef RADIATA_COMMON_SRGB
#define RADIATA_COMMON_SRGB
#include "shaders/common/whole_number.glsl"

// Arguments outside 0 to 1 are clamped.
vec3 srgbFromLinear(vec3 linear) {
    const vec3 x = clamp(linear, 0.0, 1.0);
    return mix(12.92 * x, 1.055 * pow(max(x, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055, greaterThan(x, vec3(0.0031308)));
}

vec3 linearFromSrgb(vec3 encoded) {
    const vec3 x = clamp(encoded, 0.0, 1.0);
    return mix(x / 12.92, pow((max(x, vec3(0.04045)) + 0.055) / 1.055, vec3(2.4)), greaterThan(x, vec3(0.04045)));
}

// 8 bits each, opaque: the bytes of packUnorm4x8.
uint packedColour(vec3 encoded) {
    precise const vec3 scaled = clamp(encoded, 0.0, 1.0) * 255.0;
    return uint(wholeNumber(scaled.r) | wholeNumber(scaled.g) << 8 | wholeNumber(scaled.b) << 16) | 0xff000000u;
}

#endif
