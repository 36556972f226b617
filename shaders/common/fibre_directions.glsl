// What a pixel of a fibre keeps of directions, in 32 bits: the tangent of a line, or tangent and normal of a tube.
#ifndef RADIATA_COMMON_FIBRE_DIRECTIONS
#define RADIATA_COMMON_FIBRE_DIRECTIONS
#include "shaders/common/octahedral.glsl"
#include "shaders/common/whole_number.glsl"

// Twice 16 bits: off by less than 4e-5. \param tangent  any length but zero
uint packLine(vec3 tangent) {
    // The bits of packSnorm2x16, which a CPU driver makes lane by lane.
    precise const vec2 scaled = clamp(octahedralOf(tangent), -1.0, 1.0) * 32767.0;
    return (uint(wholeNumber(scaled.x)) & 0xffffu) | uint(wholeNumber(scaled.y)) << 16u;
}
vec3 lineTangent(uint bits) { return vectorOfOctahedral(unpackSnorm2x16(bits)); }

// Two axes orthogonal to a unit vector. Source: Duff et al. 2017.
void tubeAxes(vec3 tangent, out vec3 u, out vec3 v) {
    const float s = tangent.z < 0.0 ? -1.0 : 1.0, a = -1.0 / (s + tangent.z), b = tangent.x * tangent.y * a;
    u = vec3(1.0 + s * tangent.x * tangent.x * a, s * b, -s * tangent.x);
    v = vec3(b, s + tangent.y * tangent.y * a, -tangent.y);
}

// Tangent in twice 11 bits, off by less than 2e-3, and the angle of the normal about it in 10, off by less than 4e-3. A normal at a
// fibre's end keeps its part that is orthogonal to the tangent.
vec3 tubeTangent(uint bits) { return vectorOfOctahedral(vec2(bits & 2047u, bits >> 11u & 2047u) * (2.0 / 2047.0) - 1.0); }

uint packTube(vec3 tangent, vec3 normal) {
    const uvec2 steps = uvec2((octahedralOf(tangent) * 0.5 + 0.5) * 2047.0 + 0.5);
    const uint bits = steps.x | steps.y << 11u;
    vec3 u, v;
    tubeAxes(tubeTangent(bits), u, v);
    const float turn = atan(dot(normal, v), dot(normal, u)) / 6.28318531;
    return bits | (uint(int(floor(turn * 1024.0 + 0.5))) & 1023u) << 22u;
}

vec3 tubeNormal(uint bits) {
    vec3 u, v;
    tubeAxes(tubeTangent(bits), u, v);
    const float angle = float(bits >> 22u) * (6.28318531 / 1024.0);
    return cos(angle) * u + sin(angle) * v;
}

#endif
