// Smooths edges of a finished picture: one invocation per pixel, in encoded sRGB. For pictures of one sample, while a view moves.
// Twin: server/reference/fxaa.
// Source: Lottes 2011, FXAA 3.11 (the variant for consoles): a blur along the edge that the brightness of the four corners tells.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/pixel_place.glsl"
#include "shaders/common/srgb.glsl"
#include "shaders/common/invocation.glsl"
#include "shaders/shared/interop.glsl"

layout(buffer_reference, scalar) readonly buffer SourceBuffer { uint rgba[]; };
layout(buffer_reference, scalar) writeonly buffer PictureBuffer { uint rgba[]; };
layout(push_constant, scalar) uniform Push {
    SourceBuffer source;
    PictureBuffer picture;
    int width;
    int height;
} push;

const float kSpanMax = 8.0;          // pixels
const float kReduceLeast = 1.0 / 128.0;
const float kReduceShare = 1.0 / 8.0;
const float kContrastLeast = 1.0 / 24.0;  // below: left alone
const float kContrastShare = 1.0 / 8.0;   // of the brightest

vec3 texel(ivec2 at) {
    const ivec2 inside = clamp(at, ivec2(0), ivec2(push.width, push.height) - 1);
    return unpackUnorm4x8(push.source.rgba[inside.y * push.width + inside.x]).rgb;
}

// \param place  in pixels, whose centres are at whole numbers
vec3 between(vec2 place) {
    const ivec2 low = ivec2(floor(place));
    const vec2 share = place - vec2(low);
    return mix(mix(texel(low), texel(low + ivec2(1, 0)), share.x), mix(texel(low + ivec2(0, 1)), texel(low + ivec2(1, 1)), share.x), share.y);
}

float brightness(vec3 colour) { return dot(colour, vec3(0.299, 0.587, 0.114)); }

vec3 smoothed(ivec2 at) {
    const vec3 middle = texel(at);
    const float nw = brightness(texel(at + ivec2(-1, -1))), ne = brightness(texel(at + ivec2(1, -1)));
    const float sw = brightness(texel(at + ivec2(-1, 1))), se = brightness(texel(at + ivec2(1, 1)));
    const float m = brightness(middle);
    const float least = min(m, min(min(nw, ne), min(sw, se))), most = max(m, max(max(nw, ne), max(sw, se)));
    if (most - least < max(kContrastLeast, most * kContrastShare)) return middle;
    vec2 along = vec2(sw + se - nw - ne, nw + sw - ne - se);
    const float reduce = max((nw + ne + sw + se) * 0.25 * kReduceShare, kReduceLeast);
    along = clamp(along / (min(abs(along.x), abs(along.y)) + reduce), -kSpanMax, kSpanMax);
    const vec2 place = vec2(at);
    const vec3 narrow = 0.5 * (between(place + along * (1.0 / 3.0 - 0.5)) + between(place + along * (2.0 / 3.0 - 0.5)));
    const vec3 wide = 0.5 * narrow + 0.25 * (between(place - 0.5 * along) + between(place + 0.5 * along));
    const float wide_brightness = brightness(wide);
    return wide_brightness < least || wide_brightness > most ? narrow : wide;
}

void main() {
    const int at = int(globalInvocation());
    if (at >= push.width * push.height) return;
    push.picture.rgba[at] = packedColour(smoothed(pixelPlace(uint(at), uint(push.width))));
}
