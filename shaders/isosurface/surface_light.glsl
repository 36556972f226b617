// Light that reaches a point of a level set directly: sky and maps by the ray that escaped, discs and spheres by a ray towards each,
// and what pixels of a map have above its cap by a ray towards one of them, chosen by what they have. A sun in a map, a few pixels a
// thousand times brighter than the rest, would be met by chance once in thousands of paths.
// Twin: server/reference/path_tracer, which samples no lights.
#ifndef RADIATA_ISOSURFACE_SURFACE_LIGHT
#define RADIATA_ISOSURFACE_SURFACE_LIGHT
#include "shaders/common/low_discrepancy.glsl"
#include "shaders/isosurface/trace_volume.glsl"
#include "shaders/isosurface/lattice.glsl"

layout(buffer_reference, scalar) readonly buffer RadianceBuffer { vec3 at[]; };
layout(buffer_reference, scalar) readonly buffer BrightPixelBuffer { BrightPixel at[]; };
layout(buffer_reference, scalar) readonly buffer SunBuffer { SunParams at[]; };
layout(buffer_reference, scalar) readonly buffer SphereLightBuffer { SphereLightParams at[]; };

vec3 skyRadiance(LatticeLight light, vec3 d) {
    if (light.map_width == 0u) return light.radiance + light.gradient * dot(d, light.up);
    const vec3 m = light.map_x * d.x + light.map_y * d.y + light.map_z * d.z;
    const float u = atan(m.x, m.y) * 0.159154943 + 0.5, v = acos(clamp(m.z, -1.0, 1.0)) * 0.318309886;
    const uint x = min(uint(u * float(light.map_width)), light.map_width - 1u);
    const uint y = min(uint(v * float(light.map_height)), light.map_height - 1u);
    const vec3 radiance = RadianceBuffer(light.map).at[y * light.map_width + x];
    return light.map_scale * radiance * min(1.0, light.map_cap / max(luminance(radiance), 1e-30));
}

// Points of paths: `index` counts paths, `seed` says what of a path is sampled.
vec2 pathPair(LatticeParams lattice, uint index, uint seed) {
    if (lattice.random_paths == 0u) return scrambledSobolPair(index, seed);
    const uint word = childSeed(seed, index);
    return vec2(uvec2(word, mixBits(word + 0x9e3779b9u)) >> 8u) * 5.9604644775390625e-8;
}

// A direction evenly from the cone around `axis`.
vec3 coneDirection(vec3 axis, float cosine, vec2 u) {
    const vec3 other = abs(axis.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    const vec3 x_axis = normalize(cross(axis, other)), y_axis = cross(axis, x_axis);
    const float lift = u.x * (1.0 - cosine), z = 1.0 - lift, r = sqrt(max(lift * (1.0 + z), 0.0)), turn = 6.28318531 * u.y;
    return normalize(r * cos(turn) * x_axis + r * sin(turn) * y_axis + z * axis);
}

bool blocked(LatticeParams lattice, GridRay ray, vec3 d, float isovalue, float distance_mm) {
    ray.direction = gridVector(lattice.volume, d);
    return traceVolume(lattice.volume, ray, isovalue, 0.0, distance_mm, true).t < distance_mm;
}

// Irradiance from what a map has above its cap.
vec3 brightIrradiance(LatticeParams lattice, GridRay ray, vec3 n, float isovalue, uint index, uint seed) {
    const LatticeLight light = lattice.light;
    const vec2 u = pathPair(lattice, index, childSeed(seed, 128u)), v = pathPair(lattice, index, childSeed(seed, 129u));
    const BrightPixel chosen = BrightPixelBuffer(light.bright).at[min(uint(u.x * float(light.bright_count)), light.bright_count - 1u)];
    const uint pixel = u.y < chosen.keep ? chosen.pixel : chosen.other;
    const float row = float(pixel / light.map_width), turn = (float(pixel % light.map_width) + v.x) / float(light.map_width) - 0.5;
    const float step = 3.14159265 / float(light.map_height);
    const float z = mix(cos(step * row), cos(step * (row + 1.0)), v.y), r = sqrt(max(1.0 - z * z, 0.0));
    const vec3 m = vec3(r * sin(6.28318531 * turn), r * cos(6.28318531 * turn), z);
    const vec3 d = vec3(dot(light.map_x, m), dot(light.map_y, m), dot(light.map_z, m));
    const float cosine = dot(n, d);
    if (cosine <= 0.0 || blocked(lattice, ray, d, isovalue, VOLUME_MISS)) return vec3(0.0);
    const vec3 radiance = RadianceBuffer(light.map).at[pixel];
    return radiance * (light.bright_weight * cosine / luminance(radiance));
}

// Irradiance at ray.base + ray.origin from discs, spheres and bright pixels. \param n  unit, world; \param seed  of this point and path
vec3 directIrradiance(LatticeParams lattice, GridRay ray, vec3 n, float isovalue, uint index, uint seed) {
    vec3 sum = vec3(0.0);
    if (lattice.light.bright_count > 0u) sum += brightIrradiance(lattice, ray, n, isovalue, index, seed);
    for (uint i = 0u; i < lattice.light.sun_count; ++i) {
        const SunParams sun = SunBuffer(lattice.light.suns).at[i];
        const vec3 d = coneDirection(sun.direction, sun.cosine, pathPair(lattice, index, childSeed(seed, 16u + i)));
        const float cosine = dot(n, d);
        // Radiance irradiance / (pi sin^2) over a solid angle of 2 pi (1 - cos): irradiance * 2 / (1 + cos).
        if (cosine > 0.0 && !blocked(lattice, ray, d, isovalue, VOLUME_MISS)) sum += sun.irradiance * (2.0 * cosine / (1.0 + sun.cosine));
    }
    for (uint i = 0u; i < lattice.light.sphere_count; ++i) {
        const SphereLightParams light = SphereLightBuffer(lattice.light.spheres).at[i];
        const vec3 grid = (light.position - vec3(ray.base)) - ray.origin;
        const vec3 towards = lattice.mm_x * grid.x + lattice.mm_y * grid.y + lattice.mm_z * grid.z;
        const float squared = dot(towards, towards), radius2 = light.radius_mm * light.radius_mm;
        if (squared <= radius2 || squared == 0.0) continue;
        const float range = sqrt(squared), cosine_max = sqrt(max(1.0 - radius2 / squared, 0.0));
        vec3 d = towards / range;
        float reach = range;
        if (light.radius_mm > 0.0) {
            d = coneDirection(d, cosine_max, pathPair(lattice, index, childSeed(seed, 64u + i)));
            const float along = dot(towards, d);
            reach = along - sqrt(max(radius2 - (squared - along * along), 0.0));
        }
        const float cosine = dot(n, d);
        // Of a sphere: radiance intensity / (pi radius^2) over 2 pi (1 - cos), which is intensity / squared * 2 / (1 + cos).
        if (cosine > 0.0 && !blocked(lattice, ray, d, isovalue, reach)) sum += light.intensity * (2.0 * cosine / (squared * (1.0 + cosine_max)));
    }
    return sum;
}

#endif
