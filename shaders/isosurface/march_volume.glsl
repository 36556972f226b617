// First crossing of an isosurface by steps of equal length and bisection, as volume renderers commonly find it: a pair of crossings
// within one step is missed. Here to compare with trace_volume.glsl; bricks without the isovalue are left out as there.
#ifndef RADIATA_ISOSURFACE_MARCH_VOLUME
#define RADIATA_ISOSURFACE_MARCH_VOLUME
#include "shaders/isosurface/trace_volume.glsl"

// Value less the isovalue; VOLUME_NO_VALUE in a cell without numbers. \param p  grid coordinates less the ray's base
float marchValue(VolumeParams volume, GridRay ray, float isovalue, float t, out ivec3 cell, out vec3 at) {
    const vec3 p = ray.origin + t * ray.direction;
    const ivec3 relative = clamp(ivec3(floor(p)), -ray.base, volume.size - 2 - ray.base);
    cell = relative + ray.base;
    at = clamp(p - vec3(relative), 0.0, 1.0);
    float c[8];
    return cellCorners(volume, cell, isovalue, c) ? cellValue(c, at) : VOLUME_NO_VALUE;
}

// \param step  in shortest voxel edges; t counts in mm
VolumeHit marchVolume(VolumeParams volume, GridRay ray, float isovalue, float t_min, float t_max, bool bricks, float step,
                      uint bisections) {
    VolumeHit hit = VolumeHit(VOLUME_MISS, ivec3(0), vec3(0.0), false, 0u);
    const vec3 low = vec3(-ray.base), high = vec3(volume.size - 1 - ray.base);
    const bvec3 parallel = equal(ray.direction, vec3(0.0));
    const vec3 inverse = 1.0 / mix(ray.direction, vec3(1e-30), parallel);
    const vec3 a = (low - ray.origin) * inverse, b = (high - ray.origin) * inverse;
    const vec3 first = min(a, b), last = max(a, b);
    const float begin = max(t_min, max(first.x, max(first.y, first.z))), end = min(t_max, min(last.x, min(last.y, last.z)));
    if (!(begin <= end)) return hit;
    const float length_mm = step * volume.voxel_mm;
    float t = begin;
    ivec3 cell;
    vec3 at;
    float value = marchValue(volume, ray, isovalue, t, cell, at);
    const GridSlopes slopes = gridSlopes(volume, ray);
    ivec3 known_brick = ivec3(-1), known_block = ivec3(-1);
    // However little a step moves a ray that is far off, it ends.
    uint turns = uint(min((end - begin) / length_mm, 1e5)) + 4u * uint(volume.size.x + volume.size.y + volume.size.z);
    while (t < end && --turns > 0u) {
        // A sample for each run of boxes without the isovalue: where the ray leaves the last of them.
        bool left_out = false;
        while (bricks && t < end && cell >> int(BRICK_SHIFT) != known_brick && --turns > 0u) {
            ++hit.steps;
            int shift, axis;
            if (sideOfBox(volume, cell, isovalue, known_block, shift) == kSideUnknown) {
                known_brick = cell >> int(BRICK_SHIFT);
            } else {
                const ivec3 box = ((cell >> shift) << shift) - ray.base;
                t = max(t, min(leaveCells(ray, slopes, box, 1 << shift, axis), end)) + 1e-3 * length_mm;
                cell = cellAt(ray, t, slopes.low_cell, slopes.high_cell) + ray.base;
                left_out = true;
            }
        }
        if (left_out) value = marchValue(volume, ray, isovalue, min(t, end), cell, at);
        if (t >= end) break;
        ++hit.steps;
        const float next = min(t + length_mm, end);
        ivec3 next_cell;
        const float next_value = marchValue(volume, ray, isovalue, next, next_cell, at);
        const bool numbers = value < VOLUME_NO_VALUE && next_value < VOLUME_NO_VALUE;
        if (numbers && (value >= 0.0) != (next_value >= 0.0)) {
            float before = t, behind = next;
            for (uint i = 0u; i < bisections; ++i) {
                const float middle = 0.5 * (before + behind);
                const bool same = (marchValue(volume, ray, isovalue, middle, cell, at) >= 0.0) == (value >= 0.0);
                if (same) before = middle;
                else behind = middle;
            }
            hit.t = 0.5 * (before + behind);
            hit.inside = value >= 0.0;
            marchValue(volume, ray, isovalue, hit.t, hit.cell, hit.at);
            return hit;
        }
        t = next;
        value = next_value;
        cell = next_cell;
    }
    return hit;
}

#endif
