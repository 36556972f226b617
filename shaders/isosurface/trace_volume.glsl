// First crossing of an isosurface along a ray: a walk through the grid that leaves out blocks and bricks without the isovalue, and
// the cubic of each cell that has it. No step size: what the trilinear volume has is found.
// Cells that share a face see the same value there (cubic.glsl), and the side on which the ray is goes along with it over everything
// that is left out, so rays do not slip through between cells. Twin: server/reference/scalar_field.
// Sources: Amanatides and Woo 1987 (the walk); Parker et al. 1998 (ranges of macrocells).
#ifndef RADIATA_ISOSURFACE_TRACE_VOLUME
#define RADIATA_ISOSURFACE_TRACE_VOLUME
#include "shaders/common/volume.glsl"
#include "shaders/common/whole_number.glsl"

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
    int turns;        // that are left
    ivec3 brick;      // the latest one that has the isovalue, or none
    ivec3 block;
};

// What of a ray stays the same from cell to cell.
struct GridSlopes {
    vec3 inverse;   // of the direction; 0 along axes that the ray does not move on
    vec3 never;     // VOLUME_MISS there, else 0
    bvec3 up;
    ivec3 low_cell, high_cell;  // of the volume, less the ray's base
};

GridSlopes gridSlopes(VolumeParams volume, GridRay ray) {
    const bvec3 parallel = equal(ray.direction, vec3(0.0));
    return GridSlopes(mix(1.0 / mix(ray.direction, vec3(1.0), parallel), vec3(0.0), parallel), mix(vec3(0.0), vec3(VOLUME_MISS), parallel),
                      greaterThan(ray.direction, vec3(0.0)), -ray.base, volume.size - 2 - ray.base);
}

// Parameter where the ray leaves a box of cells [low, low + extent), and by which axis.
float leaveCells(GridRay ray, GridSlopes slopes, ivec3 low, int extent, out int axis) {
    const vec3 plane = vec3(low + mix(ivec3(0), ivec3(extent), slopes.up));
    const vec3 leave = (plane - ray.origin) * slopes.inverse + slopes.never;
    axis = leave.x <= leave.y && leave.x <= leave.z ? 0 : leave.y <= leave.z ? 1 : 2;
    return min(leave.x, min(leave.y, leave.z));
}

// Cell of the box [low, high] in which the ray is at parameter t, but for rounding. CPU drivers turn floats into integers lane by lane,
// hence wholeNumber.
ivec3 cellAt(GridRay ray, float t, ivec3 low, ivec3 high) {
    const vec3 cell = clamp(floor(ray.origin + t * ray.direction), vec3(low), vec3(high));
    return ivec3(wholeNumber(cell.x), wholeNumber(cell.y), wholeNumber(cell.z));
}

// Place in the cell at parameter t; exact on the face by which the ray came or goes (\param axis, or -1).
vec3 placeInCell(GridRay ray, ivec3 cell, float t, int axis, bool entered) {
    vec3 at = clamp((ray.origin - vec3(cell)) + t * ray.direction, 0.0, 1.0);
    if (axis >= 0) at[axis] = (ray.direction[axis] > 0.0) == entered ? 0.0 : 1.0;
    return at;
}

// Side of all samples of the block or the brick that a cell of the volume is in, kSideUnknown if both have the isovalue.
// \param block  the latest that is known to have it  \param shift  log2 of the box's edge
int sideOfBox(VolumeParams volume, ivec3 cell, float isovalue, inout ivec3 block, out int shift) {
    const ivec3 own = cell >> int(BLOCK_SHIFT), brick = cell >> int(BRICK_SHIFT);
    shift = int(BLOCK_SHIFT);
    if (own != block) {
        const int at = own.x + volume.block_size.x * (own.y + volume.block_size.y * own.z);
        const int side = sideOfRange(RangeOfValues(volume.blocks).at[at], isovalue);
        if (side != kSideUnknown) return side;
        block = own;
    }
    shift = int(BRICK_SHIFT);
    const int at = brick.x + volume.brick_size.x * (brick.y + volume.brick_size.y * brick.z);
    return sideOfRange(RangeOfValues(volume.bricks).at[at], isovalue);
}

// Moves on to the cell behind a box of cells that the ray leaves at t by axis. \return whether the ray goes on there
bool enterNext(GridRay ray, GridSlopes slopes, inout GridWalk walk, ivec3 low, int extent, float t, int axis) {
    walk.t = max(walk.t, t);
    const ivec3 cell = extent > 1 ? cellAt(ray, walk.t, low, min(low + extent - 1, slopes.high_cell)) : low;
    walk.cell = mix(cell, low + mix(ivec3(-1), ivec3(extent), slopes.up), equal(ivec3(axis), ivec3(0, 1, 2)));
    walk.axis = axis;
    const uvec3 cells = uvec3(slopes.high_cell - slopes.low_cell);
    return walk.t < walk.t_end && --walk.turns > 0 && all(lessThanEqual(uvec3(walk.cell - slopes.low_cell), cells));
}

// \param bricks  whether to leave out bricks and blocks; only measurements say no
// A ray that begins on the surface may find it again at once: let it begin a little off.
VolumeHit traceVolume(VolumeParams volume, GridRay ray, float isovalue, float t_min, float t_max, bool bricks) {
    VolumeHit hit = VolumeHit(VOLUME_MISS, ivec3(0), vec3(0.0), false, 0u);
    const GridSlopes slopes = gridSlopes(volume, ray);
    const vec3 low = vec3(slopes.low_cell), high = vec3(slopes.high_cell + 1);
    const bvec3 parallel = greaterThan(slopes.never, vec3(0.0));
    const vec3 a = (low - ray.origin) * slopes.inverse, b = (high - ray.origin) * slopes.inverse;
    const vec3 first = min(a, b) - slopes.never, last = max(a, b) + slopes.never;
    if (any(bvec3(parallel.x && !(ray.origin.x >= low.x && ray.origin.x <= high.x),
                  parallel.y && !(ray.origin.y >= low.y && ray.origin.y <= high.y),
                  parallel.z && !(ray.origin.z >= low.z && ray.origin.z <= high.z)))) {
        return hit;
    }
    GridWalk walk;
    walk.t = max(t_min, max(first.x, max(first.y, first.z)));
    walk.t_end = min(t_max, min(last.x, min(last.y, last.z)));
    if (!(walk.t <= walk.t_end)) return hit;
    walk.cell = cellAt(ray, walk.t, slopes.low_cell, slopes.high_cell);
    walk.axis = -1;
    walk.side = kSideUnknown;
    walk.brick = ivec3(-1);
    walk.block = ivec3(-1);
    // Every turn moves on by a cell at least, but for the rounding of where a brick is left: twice as many will do for any ray.
    walk.turns = 2 * (volume.size.x + volume.size.y + volume.size.z);
    bool more = true;
    while (more) {
        bool found = false;
        float c[8];
        float leave = 0.0;
        int leave_axis = 0;
        // Boxes are left out until every lane of a subgroup is in a brick with the isovalue, or done; only then are cells looked at.
        while (bricks && more && (walk.cell + ray.base) >> int(BRICK_SHIFT) != walk.brick) {
            ++hit.steps;
            const ivec3 cell = walk.cell + ray.base;
            int shift;
            const int known = sideOfBox(volume, cell, isovalue, walk.block, shift);
            if (known == kSideUnknown) {
                walk.brick = cell >> int(BRICK_SHIFT);
            } else {
                walk.side = known;
                const ivec3 box = ((cell >> shift) << shift) - ray.base;
                int axis;
                const float leave_box = leaveCells(ray, slopes, box, 1 << shift, axis);
                more = enterNext(ray, slopes, walk, box, 1 << shift, leave_box, axis);
            }
        }
        while (more && !found && (!bricks || (walk.cell + ray.base) >> int(BRICK_SHIFT) == walk.brick)) {
            ++hit.steps;
            leave = leaveCells(ray, slopes, walk.cell, 1, leave_axis);
            const bool numbers = cellCorners(volume, walk.cell + ray.base, isovalue, c);
            const vec2 range = cornerRange(c);
            const int known = range.x >= 0.0 ? kSideIn : range.y < 0.0 ? kSideOut : kSideUnknown;
            if (!numbers) walk.side = kSideUnknown;
            found = numbers && (known == kSideUnknown || (walk.side != kSideUnknown && walk.side != known));
            if (numbers && !found) walk.side = known;
            if (!found) more = enterNext(ray, slopes, walk, walk.cell, 1, leave, leave_axis);
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
            more = enterNext(ray, slopes, walk, walk.cell, 1, leave, leave_axis);
        }
    }
    return hit;
}

#endif
