// First crossing of an isosurface along a ray: a walk through the grid that leaves out blocks and bricks without the isovalue, and
// the cubic of each cell that has it. No step size: what the trilinear volume has is found.
// Cells that share a face see the same value there (cubic.glsl), and the side on which the ray is goes along with it over everything
// that is left out, so rays do not slip through between cells. Twin: server/reference/scalar_field.
// Sources: Amanatides and Woo 1987 (the walk); Parker et al. 1998 (ranges of macrocells).
#ifndef RADIATA_ISOSURFACE_TRACE_VOLUME
#define RADIATA_ISOSURFACE_TRACE_VOLUME
#include "shaders/common/volume.glsl"

// The point at parameter t is base + origin + t * direction, in grid coordinates. Precision is that of origin + t * direction, so
// base is best near to where the hits are expected; 0 will do for a ray that begins on a grid point's cell.
struct GridRay {
    ivec3 base;
    vec3 origin;
    vec3 direction;  // grid units per unit of t; not 0
};

struct VolumeHit {
    float t;      // VOLUME_MISS: none
    ivec3 cell;   // in grid coordinates the hit is at cell + at; at in [0, 1]^3
    vec3 at;
    bool inside;  // the ray came from values of at least the isovalue
    uint steps;   // cells, bricks and blocks that were looked at
};
#define VOLUME_MISS 3.4e38

const int kSideOut = -1, kSideUnknown = 0, kSideIn = 1;

int sideOf(float value) { return value >= 0.0 ? kSideIn : kSideOut; }

// Side of all of a range; kSideUnknown: it has the isovalue in it. \param range  least and largest sample
int sideOfRange(vec2 range, float isovalue) {
    return range.x >= isovalue ? kSideIn : range.y < isovalue ? kSideOut : kSideUnknown;
}

struct GridWalk {
    float t, t_end;
    ivec3 cell;       // grid coordinates less the ray's base
    int axis;         // of the face by which the cell was entered; -1: the ray begins here
    int side;
    ivec3 brick;      // the latest one that has the isovalue, or none
    ivec3 block;
};

// Parameter where the ray leaves a box of cells [low, low + extent), and by which axis.
float leaveCells(GridRay ray, vec3 inverse, ivec3 low, int extent, out int axis) {
    const vec3 plane = vec3(low) + mix(vec3(0.0), vec3(float(extent)), greaterThan(ray.direction, vec3(0.0)));
    vec3 leave = (plane - ray.origin) * inverse;
    leave = mix(leave, vec3(VOLUME_MISS), equal(ray.direction, vec3(0.0)));
    axis = leave.x <= leave.y && leave.x <= leave.z ? 0 : leave.y <= leave.z ? 1 : 2;
    return min(leave.x, min(leave.y, leave.z));
}

// Place in the cell at parameter t; exact on the face by which the ray came or goes (\param axis, or -1).
vec3 placeInCell(GridRay ray, ivec3 cell, float t, int axis, bool entered) {
    vec3 at = clamp((ray.origin - vec3(cell)) + t * ray.direction, 0.0, 1.0);
    if (axis >= 0) at[axis] = (ray.direction[axis] > 0.0) == entered ? 0.0 : 1.0;
    return at;
}

// Moves on to the cell behind a box of cells that the ray leaves at t by axis.
void enterNext(GridRay ray, inout GridWalk walk, ivec3 low, int extent, ivec3 high_cell, float t, int axis) {
    walk.t = max(walk.t, t);
    if (extent > 1) {
        const ivec3 cell = ivec3(floor(ray.origin + walk.t * ray.direction));
        walk.cell = clamp(cell, low, min(low + extent - 1, high_cell));
    }
    walk.cell[axis] = ray.direction[axis] > 0.0 ? low[axis] + extent : low[axis] - 1;
    walk.axis = axis;
}

// \param bricks  whether to leave out bricks and blocks; only measurements say no
// A ray that begins on the surface may find it again at once: let it begin a little off.
VolumeHit traceVolume(VolumeParams volume, GridRay ray, float isovalue, float t_min, float t_max, bool bricks) {
    VolumeHit hit = VolumeHit(VOLUME_MISS, ivec3(0), vec3(0.0), false, 0u);
    const ivec3 low_cell = -ray.base, high_cell = volume.size - 2 - ray.base;
    const vec3 low = vec3(low_cell), high = vec3(high_cell + 1);
    const bvec3 parallel = equal(ray.direction, vec3(0.0));
    const vec3 inverse = 1.0 / mix(ray.direction, vec3(1.0), parallel);
    const vec3 a = (low - ray.origin) * inverse, b = (high - ray.origin) * inverse;
    const vec3 first = mix(min(a, b), vec3(-VOLUME_MISS), parallel), last = mix(max(a, b), vec3(VOLUME_MISS), parallel);
    if (any(bvec3(parallel.x && !(ray.origin.x >= low.x && ray.origin.x <= high.x),
                  parallel.y && !(ray.origin.y >= low.y && ray.origin.y <= high.y),
                  parallel.z && !(ray.origin.z >= low.z && ray.origin.z <= high.z)))) {
        return hit;
    }
    GridWalk walk;
    walk.t = max(t_min, max(first.x, max(first.y, first.z)));
    walk.t_end = min(t_max, min(last.x, min(last.y, last.z)));
    if (!(walk.t <= walk.t_end)) return hit;
    walk.cell = clamp(ivec3(floor(ray.origin + walk.t * ray.direction)), low_cell, high_cell);
    walk.axis = -1;
    walk.side = kSideUnknown;
    walk.brick = ivec3(-1);
    walk.block = ivec3(-1);
    bool more = true;
    // Every turn moves on by a cell at least, but for the rounding of where a brick is left: twice as many will do for any ray.
    int turns = 2 * (volume.size.x + volume.size.y + volume.size.z);
    while (more) {
        bool found = false;
        float c[8];
        float leave = 0.0;
        int leave_axis = 0;
        while (more && !found) {
            ++hit.steps;
            const ivec3 cell = walk.cell + ray.base;
            int extent = 1;
            int known = kSideUnknown;
            if (bricks) {
                const ivec3 block = cell >> int(BLOCK_SHIFT), brick = cell >> int(BRICK_SHIFT);
                if (block != walk.block) {
                    const int at = block.x + volume.block_size.x * (block.y + volume.block_size.y * block.z);
                    known = sideOfRange(RangeOfValues(volume.blocks).at[at], isovalue);
                    if (known != kSideUnknown) extent = 1 << int(BLOCK_SHIFT);
                    else walk.block = block;
                }
                if (extent == 1 && brick != walk.brick) {
                    const int at = brick.x + volume.brick_size.x * (brick.y + volume.brick_size.y * brick.z);
                    known = sideOfRange(RangeOfValues(volume.bricks).at[at], isovalue);
                    if (known != kSideUnknown) extent = 1 << int(BRICK_SHIFT);
                    else walk.brick = brick;
                }
            }
            const ivec3 box = ((cell >> findLSB(extent)) << findLSB(extent)) - ray.base;
            leave = leaveCells(ray, inverse, box, extent, leave_axis);
            if (extent == 1) {
                const bool numbers = cellCorners(volume, cell, isovalue, c);
                const vec2 range = cornerRange(c);
                known = range.x >= 0.0 ? kSideIn : range.y < 0.0 ? kSideOut : kSideUnknown;
                if (!numbers) walk.side = kSideUnknown;
                found = numbers && (known == kSideUnknown || (walk.side != kSideUnknown && walk.side != known));
                if (numbers && !found) walk.side = known;
            } else {
                walk.side = known;
            }
            if (!found) {
                enterNext(ray, walk, box, extent, high_cell, leave, leave_axis);
                more = walk.t < walk.t_end && --turns > 0 && all(greaterThanEqual(walk.cell, low_cell)) &&
                       all(lessThanEqual(walk.cell, high_cell));
            }
        }
        if (found) {
            const float end = min(max(leave, walk.t), walk.t_end);
            const vec3 from = placeInCell(ray, walk.cell, walk.t, walk.axis, true);
            const vec3 to = placeInCell(ray, walk.cell, end, leave <= walk.t_end ? leave_axis : -1, false);
            const float value_from = cellValue(c, from), value_to = cellValue(c, to);
            const bool slipped = walk.side != kSideUnknown && walk.side != sideOf(value_from);
            const float u = slipped ? 0.0 : firstCubicRoot(cellCubic(c, from, to, value_from, value_to), value_to);
            if (u >= 0.0) {
                hit.t = walk.t + u * (end - walk.t);
                hit.cell = walk.cell + ray.base;
                hit.at = from + u * (to - from);
                hit.inside = slipped ? walk.side == kSideIn : value_from >= 0.0;
                return hit;
            }
            walk.side = sideOf(value_to);
            enterNext(ray, walk, walk.cell, 1, high_cell, leave, leave_axis);
            more = walk.t < walk.t_end && --turns > 0 && all(greaterThanEqual(walk.cell, low_cell)) &&
                   all(lessThanEqual(walk.cell, high_cell));
        }
    }
    return hit;
}

#endif
