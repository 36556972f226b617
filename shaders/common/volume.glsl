// Samples of a volume, and gradients from them.
// The gradient of the cubic B-spline through 4x4x4 samples (they are its coefficients, so it smooths) hides the facets and the noise
// of trilinear cells. Twin: server/reference/scalar_field. Source: Wyman et al. 2006, Sec. 4.1.1.
#ifndef RADIATA_COMMON_VOLUME
#define RADIATA_COMMON_VOLUME
#include "shaders/shared/isosurface.glsl"
#include "shaders/common/cubic.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SampleBuffer { float at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer RangeOfValues { vec2 at[]; };

// Samples of one plane k; planes are reached by 64-bit addresses, so volumes may be larger than 4 GiB.
SampleBuffer volumePlane(VolumeParams volume, int k) {
    const uint64_t plane = uint64_t(uint(volume.size.x) * uint(volume.size.y));
    return SampleBuffer(volume.samples + uint64_t(uint(k)) * plane * 4ul);
}

// Corners of a cell less the isovalue; \return false if one has no number. \param cell  0 to size - 2
bool cellCorners(VolumeParams volume, ivec3 cell, float isovalue, out float c[8]) {
    SampleBuffer below = volumePlane(volume, cell.z), above = volumePlane(volume, cell.z + 1);
    const int i = cell.x + volume.size.x * cell.y, j = i + volume.size.x;
    c[0] = below.at[i];
    c[1] = below.at[i + 1];
    c[2] = below.at[j];
    c[3] = below.at[j + 1];
    c[4] = above.at[i];
    c[5] = above.at[i + 1];
    c[6] = above.at[j];
    c[7] = above.at[j + 1];
    const float highest = max(max(max(c[0], c[1]), max(c[2], c[3])), max(max(c[4], c[5]), max(c[6], c[7])));
    for (int n = 0; n < 8; ++n) c[n] -= isovalue;
    return highest < VOLUME_NO_VALUE;
}

// Least and largest of a cell's corners.
vec2 cornerRange(float c[8]) {
    return vec2(min(min(min(c[0], c[1]), min(c[2], c[3])), min(min(c[4], c[5]), min(c[6], c[7]))),
                max(max(max(c[0], c[1]), max(c[2], c[3])), max(max(c[4], c[5]), max(c[6], c[7]))));
}

// The four weights of a uniform cubic B-spline, and their derivatives.
vec4 splineWeights(float x) {
    const float y = 1.0 - x, x2 = x * x;
    return vec4(y * y * y, (3.0 * x - 6.0) * x2 + 4.0, ((-3.0 * x + 3.0) * x + 3.0) * x + 1.0, x2 * x) / 6.0;
}
vec4 splineSlopes(float x) {
    const float y = 1.0 - x;
    return vec4(-0.5 * y * y, (1.5 * x - 2.0) * x, (-1.5 * x + 1.0) * x + 0.5, 0.5 * x * x);
}

// In a cell at the volume's face the fourth sample is beyond it. It goes on as the two before it do, by a straight line, so linear
// fields have their gradient everywhere; with the face's own sample instead, normals there would lean inwards. \param weights  changed
// so that the sample beyond counts no more
vec4 faceWeights(vec4 weights, int cell, int size) {
    if (cell == 0) weights = vec4(0.0, weights.y + 2.0 * weights.x, weights.z - weights.x, weights.w);
    if (cell == size - 2) weights = vec4(weights.x, weights.y - weights.w, weights.z + 2.0 * weights.w, 0.0);
    return weights;
}

// Per grid unit, of the cubic B-spline. Where one of the 64 has no number the
// trilinear gradient is taken. \param cell, at  the point is cell + at, at in [0, 1]^3, and the cell's corners are numbers
vec3 splineGradient(VolumeParams volume, ivec3 cell, vec3 at) {
    float c[8];
    cellCorners(volume, cell, 0.0, c);
    const float middle = c[0];  // weights of slopes add up to 0, so subtracting it changes nothing but the rounding
    const vec4 wx = faceWeights(splineWeights(at.x), cell.x, volume.size.x), sx = faceWeights(splineSlopes(at.x), cell.x, volume.size.x);
    const vec4 wy = faceWeights(splineWeights(at.y), cell.y, volume.size.y), sy = faceWeights(splineSlopes(at.y), cell.y, volume.size.y);
    const vec4 wz = faceWeights(splineWeights(at.z), cell.z, volume.size.z), sz = faceWeights(splineSlopes(at.z), cell.z, volume.size.z);
    const ivec4 i = clamp(cell.x + ivec4(-1, 0, 1, 2), 0, volume.size.x - 1);
    vec3 gradient = vec3(0.0);
    bool complete = true;
    for (int k = 0; k < 4; ++k) {
        SampleBuffer plane = volumePlane(volume, clamp(cell.z + k - 1, 0, volume.size.z - 1));
        vec3 sum = vec3(0.0);  // slope along x, along y, value
        for (int j = 0; j < 4; ++j) {
            const int row = volume.size.x * clamp(cell.y + j - 1, 0, volume.size.y - 1);
            const vec4 raw = vec4(plane.at[row + i.x], plane.at[row + i.y], plane.at[row + i.z], plane.at[row + i.w]);
            complete = complete && max(max(raw.x, raw.y), max(raw.z, raw.w)) < VOLUME_NO_VALUE;
            const vec4 v = raw - middle;
            const float value = dot(wx, v);
            sum += vec3(wy[j] * dot(sx, v), sy[j] * value, wy[j] * value);
        }
        gradient += vec3(wz[k] * sum.xy, sz[k] * sum.z);
    }
    return complete ? gradient : cellGradient(c, at);
}

// Per mm along world axes, from a gradient per grid unit.
vec3 worldGradient(VolumeParams volume, vec3 gradient) {
    return vec3(dot(volume.grid_x, gradient), dot(volume.grid_y, gradient), dot(volume.grid_z, gradient));
}

// Grid vector of a world vector in mm.
vec3 gridVector(VolumeParams volume, vec3 world) {
    return volume.grid_x * world.x + volume.grid_y * world.y + volume.grid_z * world.z;
}

#endif
