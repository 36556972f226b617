// Light that reaches a point of a level set directly: sky and maps by the ray that escaped, discs and spheres by a ray towards each.
// Twin: server/reference/path_tracer, which samples no lights.
#ifndef RADIATA_ISOSURFACE_SURFACE_LIGHT
#define RADIATA_ISOSURFACE_SURFACE_LIGHT
#include "shaders/common/low_discrepancy.glsl"
#include "shaders/isosurface/trace_volume.glsl"
#include "shaders/shared/lattice.glsl"

layout(buffer_reference, scalar) readonly buffer RadianceBuffer { vec3 at[]; };
layout(buffer_reference, scalar) readonly buffer SunBuffer { SunParams at[]; };
layout(buffer_reference, scalar) readonly buffer SphereLightBuffer { SphereLightParams at[]; };

vec3 skyRadiance(LatticeLight light, vec3 d) {
    if (light.map_width == 0u) return light.radiance + light.gradient * dot(d, light.up);
    const vec3 m = light.map_x * d.x + light.map_y * d.y + light.map_z * d.z;
    const float u = atan(m.x, m.y) * 0.159154943 + 0.5, v = acos(clamp(m.z, -1.0, 1.0)) * 0.318309886;
    const uint x = min(uint(u * float(light.map_width)), light.map_width - 1u);
    const uint y = min(uint(v * float(light.map_height)), light.map_height - 1u);
    return light.map_scale * RadianceBuffer(light.map).at[y * light.map_width + x];
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

// Irradiance at ray.base + ray.origin from discs and spheres. \param n  unit, world; \param seed  of this point and path
vec3 directIrradiance(LatticeParams lattice, GridRay ray, vec3 n, float isovalue, uint index, uint seed) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < lattice.light.sun_count; ++i) {
        const SunParams sun = SunBuffer(lattice.light.suns).at[i];
        const vec3 d = coneDirection(sun.direction, sun.cosine, scrambledSobolPair(index, childSeed(seed, 16u + i)));
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
            d = coneDirection(d, cosine_max, scrambledSobolPair(index, childSeed(seed, 64u + i)));
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
