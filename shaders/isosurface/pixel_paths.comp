// Path tracing of the visible pixels of a layer: each invocation adds one path of each replicate to its pixel, from the point that the
// pixel shows, and writes what all paths so far say: radiance of a white diffuse surface. Nothing is kept for other cameras. The
// comparison of Wyman et al. 2006, Table 1 ("path traced"); paths are those of the lattice's texels (light_paths.glsl).
// Stages double; a pixel whose error was small enough at the end of one is left as it is.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/isosurface/layer.glsl"
#include "shaders/isosurface/hit_point.glsl"
#include "shaders/isosurface/light_paths.glsl"
#include "shaders/shared/pixel_paths.glsl"

layout(buffer_reference, scalar) buffer PathBuffer { PixelPaths at[]; };
layout(buffer_reference, scalar) writeonly buffer GlobalLightBuffer { vec3 at[]; };

layout(push_constant, scalar) uniform Push {
    FrameBuffer frame;
    SurfaceLayerBuffer layer;
    SurfaceBuffer surface;
    LatticeBuffer lattice;  // its volume, light, bounces and albedo; there are no texels
    PathBuffer paths;
    GlobalLightBuffer light;
    uint path;             // of each replicate
    uint least;            // paths of each replicate before an error counts
    float relative_error;  // that is wanted
    uint seed;             // of the picture's sample
    uint first_block_row;  // of this dispatch, in blocks of 8x8 pixels
} push;

void main() {
    const FrameParams frame = push.frame.frame;
    const uvec2 pixel = pixelOfInvocation(push.first_block_row);
    if (pixel.x >= frame.width || pixel.y >= frame.height) return;
    const uint at = pixel.y * frame.width + pixel.x;
    const IsosurfaceParams layer = push.layer.at[0];
    const Surface surface = push.surface.at[at];
    if (surface.who == 0xffffffffu || (surface.layer_and_steps >> 24u) != layer.layer) return;
    PixelPaths paths = push.paths.at[at];
    if (push.path == 0u) paths = PixelPaths(vec3(0.0), 1e30, vec4(0.0), 0u);
    else if (paths.relative_error < 0.0 || (push.path >= push.least && paths.relative_error <= push.relative_error)) return;
    const LatticeParams lattice = push.lattice.lattice;
    SurfacePoint point;
    point.place = hitPoint(frame, layer, at, surface.depth);
    point.isovalue = layer.isovalue;
    point.normal = outwardNormal(lattice.volume, point.place);
    if (point.normal == vec3(0.0)) {
        push.paths.at[at] = PixelPaths(vec3(0.0), -1.0, vec4(0.0), 0u);
        push.light.at[at] = vec3(-1.0);
        return;
    }
    const uint pixel_seed = childSeed(push.seed, at);
    for (uint replicate = 0u; replicate < LATTICE_REPLICATES; ++replicate) {
        const PathLight found =
            followPath(lattice, point, false, push.path, childSeed(pixel_seed, replicate), TexelFloats(lattice.payload));
        vec3 irradiance = vec3(0.0), weight = vec3(1.0);
        for (uint k = 0u; k <= lattice.bounces; ++k) {
            irradiance += weight * found.irradiance[k];
            weight *= lattice.albedo;
        }
        paths.sum += irradiance;
        paths.replicates[replicate] += luminance(irradiance);
    }
    const uint count = push.path + 1u;
    if ((count & push.path) == 0u) {
        const vec4 means = paths.replicates / float(count);
        const float mean = 0.25 * (means.x + means.y + means.z + means.w);
        const vec4 off = means - mean;
        paths.relative_error = sqrt(dot(off, off) / 12.0) / max(mean, lattice.irradiance_floor);
    }
    paths.count = count;
    push.paths.at[at] = paths;
    push.light.at[at] = paths.sum / (float(LATTICE_REPLICATES * count) * kPi);
}
