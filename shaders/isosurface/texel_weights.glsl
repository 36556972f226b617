// Which texels light a point of the shown surface, and by how much. Source: Wyman et al. 2006, Sec. 4.2 and Fig. 6.
#ifndef RADIATA_ISOSURFACE_TEXEL_WEIGHTS
#define RADIATA_ISOSURFACE_TEXEL_WEIGHTS
#include "shaders/isosurface/lattice.glsl"
#include "shaders/isosurface/level_set.glsl"

// model::TexelInterpolation
#define INTERPOLATE_OWN_ISOVALUE 0u
#define INTERPOLATE_NEAREST 1u
#define INTERPOLATE_TRILINEAR 2u
#define INTERPOLATE_TRICUBIC 3u

layout(constant_id = 1) const uint kInterpolation = INTERPOLATE_TRILINEAR;

const int kWidth = kInterpolation == INTERPOLATE_TRICUBIC ? 4 : 2;  // texels along an axis that may count
const int kTexels = kWidth * kWidth * kWidth;

struct TexelWindow {
    ivec3 first;
    vec4 along[3];  // weights along each axis
    int only;       // the one texel that counts, or -1
};

// \param position  grid coordinates, as cell + at
TexelWindow texelWindow(LatticeParams lattice, GridPoint position, float isovalue) {
    TexelWindow window;
    const float scale = 1.0 / lattice.voxels_per_texel;
    const vec3 whole = vec3(position.cell) * scale, base = floor(whole);
    const vec3 q = (whole - base) + position.at * scale;
    const ivec3 low = clamp(ivec3(base) + ivec3(floor(q)), ivec3(0), lattice.size - 2);
    const vec3 u = clamp(q - vec3(low - ivec3(base)), 0.0, 1.0);
    window.only = -1;
    window.first = kInterpolation == INTERPOLATE_TRICUBIC ? low - 1 : low;
    for (int axis = 0; axis < 3; ++axis) {
        window.along[axis] = kInterpolation == INTERPOLATE_TRICUBIC ? splineWeights(u[axis]) : vec4(1.0 - u[axis], u[axis], 0.0, 0.0);
    }
    if (kInterpolation == INTERPOLATE_NEAREST) {
        const ivec3 near = ivec3(greaterThanEqual(u, vec3(0.5)));
        window.only = near.x + kWidth * (near.y + kWidth * near.z);
    }
    if (kInterpolation == INTERPOLATE_OWN_ISOVALUE) {
        float best = VOLUME_NO_VALUE;
        for (int i = 0; i < kTexels; ++i) {
            const vec3 at = texelPosition(lattice, low + ivec3(i & 1, (i >> 1) & 1, i >> 2));
            const ivec3 cell = min(ivec3(at), lattice.volume.size - 2);
            const float off = abs(levelAt(lattice.volume, GridPoint(cell, at - vec3(cell)), isovalue));
            if (off < best) {
                best = off;
                window.only = i;
            }
        }
    }
    return window;
}

// Texel i of the window, 0 <= i < kTexels; beyond the lattice the last one. \return its weight; all add up to 1
float windowTexel(LatticeParams lattice, TexelWindow window, int i, out ivec3 texel) {
    const ivec3 offset = ivec3(i % kWidth, (i / kWidth) % kWidth, i / (kWidth * kWidth));
    texel = clamp(window.first + offset, ivec3(0), lattice.size - 1);
    if (window.only >= 0) return i == window.only ? 1.0 : 0.0;
    return window.along[0][offset.x] * window.along[1][offset.y] * window.along[2][offset.z];
}

#endif
