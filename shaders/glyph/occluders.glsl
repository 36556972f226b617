// Glyphs of a layer that may stand between a point and its light: a walk through the hierarchy by the cone or ball that all rays of the
// point stay in, so that boxes are met once for all rays. Rays do not come from the camera, so its lists per tile are of no use here;
// rays towards one light have lists of their own, by tiles of a plane across its direction (kSunTiles).
// The includer says in kRays which rays they are.
#include "shaders/shared/bvh.glsl"

layout(buffer_reference, scalar) readonly buffer NodeBuffer { BvhNode at[]; };

struct RayBundle {
    vec3 origin;   // scene coordinates
    vec3 axis;     // unit; of the cone
    vec3 inverse;  // of the axis, for a single ray
    float sine, cosine;  // of the cone's angle
    vec3 normal;   // at the origin; all rays are above its horizon
    float radius;  // where rays end, mm; for ambient rays
};

// Whether some ray of the bundle may meet the box; never wrong in saying no, up to the boxes' own padding.
bool bundleMeets(RayBundle bundle, vec3 low, vec3 high) {
    if (kRays == kHardRays) {
        const vec2 span = boxSpan(bundle.origin, bundle.inverse, low, high);
        return span.x <= span.y && span.y >= 0.0;
    }
    const vec3 middle = 0.5 * (low + high) - bundle.origin, half_size = 0.5 * (high - low);
    if (dot(middle, bundle.normal) + dot(half_size, abs(bundle.normal)) < 0.0) return false;
    if (kRays == kAmbientRays) {
        const vec3 away = max(abs(middle) - half_size, 0.0);
        return dot(away, away) <= bundle.radius * bundle.radius;
    }
    // The ball around the box against the cone.
    const float ball = length(half_size), along = dot(middle, bundle.axis);
    const float across = sqrt(max(dot(middle, middle) - along * along, 0.0));
    return along >= -ball && across * bundle.cosine - along * bundle.sine <= ball;
}

struct BundleWalk {
    uvec2 current;  // index, count as in BvhNode
    int top;
    bool more;
};
uvec2 walk_stack[BVH_DEPTH_MAX];

BundleWalk beginWalk() { return BundleWalk(uvec2(0u, BVH_INNER), 0, true); }

// Walks the list of the light's tile that a point is in: current is then the next entry and the end.
// \param point  relative to the frame's reference point, mm; all glyphs and so all points lie within the tiles, up to rounding
BundleWalk beginList(FrameParams frame, RangeBuffer ranges, vec3 point) {
    const vec2 size = vec2(frame.sun_tiles_x, frame.sun_tiles_y);
    const vec2 at = vec2(dot(point, frame.sun_right), -dot(point, frame.sun_up)) + 0.5 * size;
    const uvec2 tile = uvec2(clamp(at, vec2(0.0), size - 1.0));
    const uvec2 range = ranges.at[tile.y * frame.sun_tiles_x + tile.x];
    return BundleWalk(uvec2(range.x, range.x + range.y), 0, range.y > 0u);
}

uint nextOfList(inout BundleWalk walk, UintBuffer entries) {
    const uint found = entries.at[walk.current.x++];
    walk.more = walk.current.x < walk.current.y;
    return found;
}

// The next glyph whose leaf the bundle reaches, or 0xffffffff.
uint nextOccluder(inout BundleWalk walk, RayBundle bundle, NodeBuffer nodes, UintBuffer order) {
    uint found = 0xffffffffu;
    while (walk.more && found == 0xffffffffu) {
        if (walk.current.y == BVH_INNER) {
            const BvhNode node = nodes.at[walk.current.x];
            const bool in0 = node.count0 != 0u && bundleMeets(bundle, node.min0, node.max0);
            const bool in1 = node.count1 != 0u && bundleMeets(bundle, node.min1, node.max1);
            const uvec2 child0 = uvec2(node.index0, node.count0), child1 = uvec2(node.index1, node.count1);
            walk.current = in0 ? child0 : child1;
            if (in0 && in1) walk_stack[walk.top++] = child1;
            if (!in0 && !in1) {
                walk.more = walk.top > 0;
                if (walk.more) walk.current = walk_stack[--walk.top];
            }
        } else {
            found = order.at[walk.current.x];
            walk.current = uvec2(walk.current.x + 1u, walk.current.y - 1u);
            if (walk.current.y == 0u) {
                walk.more = walk.top > 0;
                if (walk.more) walk.current = walk_stack[--walk.top];
            }
        }
    }
    return found;
}
