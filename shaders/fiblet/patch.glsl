// What tessellation control hands to tessellation evaluation: a fiblet's points, spread over the patch's vertices, as none of them
// may hold them all.
const uint kParts = 4u;
const uint kPartPoints = 16u;
