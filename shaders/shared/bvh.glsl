// A bounding volume hierarchy over boxes, as server/build/bvh.cpp makes it and compute shaders walk it.
// A node holds the boxes of both its children, so that one fetch of 64 bytes decides about two boxes.
#ifndef RADIATA_SHARED_BVH
#define RADIATA_SHARED_BVH
#include "shaders/shared/interop.glsl"
SHADER_NAMESPACE_BEGIN

#ifdef __cplusplus
constexpr uint BVH_INNER = 0xffffffffu;
constexpr uint BVH_LEAF_MAX = 4;
constexpr uint BVH_DEPTH_MAX = 40;
#else
#define BVH_INNER 0xffffffffu
#define BVH_LEAF_MAX 4
#define BVH_DEPTH_MAX 40
#endif

// Child 0 and child 1. A child with count BVH_INNER is the node at its index. Any other child is a leaf: count (0 to BVH_LEAF_MAX)
// primitives, whose numbers stand in the order array from its index on; a leaf of 0 primitives is never more than a filler.
// The root is node 0 and is always there. No path has more than BVH_DEPTH_MAX nodes, so a walk that pushes the farther of
// two children needs a stack of BVH_DEPTH_MAX entries.
struct BvhNode {
    vec3 min0;
    uint index0;
    vec3 max0;
    uint count0;
    vec3 min1;
    uint index1;
    vec3 max1;
    uint count1;
};
STATIC_SIZE(BvhNode, 64);

SHADER_NAMESPACE_END
#endif
