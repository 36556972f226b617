// Paths from a point of a level set: what each one finds of light, or of the transfer of distant light, by number of bounces.
// Directions are cosine-weighted, so an estimate of irradiance is pi times the radiance that comes from there. Albedo is kept out: on
// one level set it is constant, and a path's light after k bounces counts albedo^k. Sources: Wyman et al. 2006, Eq. 1 to 8 (Eq. 3
// lacks cosine and density, the second term of Eq. 4 its cosine). Twin: server/reference/path_tracer.
#ifndef RADIATA_ISOSURFACE_LIGHT_PATHS
#define RADIATA_ISOSURFACE_LIGHT_PATHS
#include "shaders/common/cosine_hemisphere.glsl"
#include "shaders/isosurface/lattice.glsl"
#include "shaders/isosurface/level_set.glsl"
#include "shaders/isosurface/surface_light.glsl"

const float kPi = 3.14159265;
const uint kBouncesMax = 4u;
// How far from its place a texel is lit on the shown surface, voxels.
const float kReach = 2.0;

struct SurfacePoint {
    GridPoint place;
    vec3 normal;
    float isovalue;  // of the level set that it lies on
};

// Of one path: irradiance by number of bounces.
struct PathLight {
    vec3 irradiance[kBouncesMax + 1u];
};

// Where the texel's paths begin. \return false: there is no surface
bool texelSurface(LatticeParams lattice, ivec3 texel, out SurfacePoint point) {
    const VolumeParams volume = lattice.volume;
    const vec3 position = texelPosition(lattice, texel);
    const ivec3 cell = min(ivec3(position), volume.size - 2);
    point.place = GridPoint(cell, position - vec3(cell));
    // A little above the texel's value, so that air of one value lies outside its own level set.
    point.isovalue = levelAt(volume, point.place, 0.0) + lattice.value_step;
    point.normal = outwardNormal(volume, point.place);
    if (point.normal == vec3(0.0) || point.isovalue < -0.5 * VOLUME_NO_VALUE) return false;
    if (lattice.projected == 0u) return true;
    // To where a ray along the smoothed gradient meets the shown surface. Newton steps with the smoothed slope do not get there: trilinear
    // values change faster than that, several times where two tissues meet within a voxel. What is beyond reach stays on its own level set.
    const vec3 gradient = splineGradient(volume, cell, point.place.at);
    const float towards = levelAt(volume, point.place, lattice.isovalue) < 0.0 ? 1.0 : -1.0;
    const GridRay ray = GridRay(cell, point.place.at, towards * gradient * inversesqrt(max(dot(gradient, gradient), 1e-36)));
    const VolumeHit hit = traceVolume(volume, ray, lattice.isovalue, 0.0, kReach * max(lattice.voxels_per_texel, 1.0), true);
    if (hit.t >= VOLUME_MISS) return true;
    point.place = GridPoint(hit.cell, hit.at);
    point.isovalue = lattice.isovalue;
    point.normal = outwardNormal(volume, point.place);
    return point.normal != vec3(0.0);
}

// \param sums  of a lattice with transfer: the payload, to which the path's harmonics are added
// \return  irradiance by bounces; with transfer that of the light as its harmonics know it
PathLight followPath(LatticeParams lattice, SurfacePoint point, bool transfer, uint index, uint seed, TexelFloats sums) {
    PathLight light;
    for (uint k = 0u; k <= kBouncesMax; ++k) light.irradiance[k] = vec3(0.0);
    uint first = 0u;
    for (uint k = 0u; k <= lattice.bounces; ++k) {
        GridRay ray;
        if (!liftOff(lattice.volume, point.place, point.normal, point.isovalue, ray)) return light;
        const uint bounce_seed = childSeed(seed, k);
        if (!transfer) light.irradiance[k] = directIrradiance(lattice, ray, point.normal, point.isovalue, index, bounce_seed);
        const vec3 d = cosineHemisphereSample(point.normal, pathPair(lattice, index, childSeed(bounce_seed, 3u)));
        ray.direction = gridVector(lattice.volume, d);
        const VolumeHit hit = traceVolume(lattice.volume, ray, point.isovalue, 0.0, VOLUME_MISS, true);
        if (hit.t >= VOLUME_MISS) {
            if (!transfer) {
                light.irradiance[k] += kPi * skyRadiance(lattice.light, d);
                return light;
            }
            float y[25];
            const uint order = orderOf(lattice, k);
            shValues(d, order, y);
            LightHarmonics harmonics = LightHarmonics(lattice.light.harmonics);
            for (uint i = 0u; i < order * order; ++i) {
                sums.at[first + i] += kPi * y[i];
                light.irradiance[k] += kPi * y[i] * harmonics.at[i];
            }
            return light;
        }
        if (hit.inside) return light;  // a ray that began inside: as dark as the inside is
        point.place = GridPoint(hit.cell, hit.at);
        point.normal = outwardNormal(lattice.volume, point.place);
        if (point.normal == vec3(0.0)) return light;
        first += orderOf(lattice, k) * orderOf(lattice, k);
    }
    return light;
}

#endif
