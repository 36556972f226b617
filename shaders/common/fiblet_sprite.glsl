// Where the ray through a point of the picture leaves a ball: what a texel's ball carves into the coverage buffer.
// Source: Schertzer et al. 2022, App. C. Its formula is for rays from the eye and balls on the axis, and lacks the term -X^2 outside of
// the root; here the ball is anywhere, and parallel rays are the case of inverse_distance 0.
#ifndef RADIATA_COMMON_FIBLET_SPRITE
#define RADIATA_COMMON_FIBLET_SPRITE
#include "shaders/shared/fiblet_draw.glsl"

// From the reference point, of depth d. \param place  column and row of the whole picture
vec3 fibletPointAt(FibletView view, vec2 place, float depth) {
    const vec3 origin = (place.x - view.centre.x) / dot(view.right, view.right) * view.right +
                        (view.centre.y - place.y) / dot(view.up, view.up) * view.up;
    return origin * (1.0 + depth * view.inverse_distance) + depth * view.forward;
}

// \return  depth behind that of the centre; that of the centre itself if the ray misses the hemisphere beyond it
float fibletCarvedDepth(FibletView view, vec2 place, vec3 centre, float radius) {
    const vec3 origin = fibletPointAt(view, place, 0.0);
    const vec3 direction = origin * view.inverse_distance + view.forward;
    const float behind = dot(view.forward, centre);
    // From the ray's point of the centre's depth on, where numbers are small.
    const vec3 from = origin + behind * direction - centre;
    const float a = dot(direction, direction), b = dot(direction, from);
    const float d = b * b - a * (dot(from, from) - radius * radius);
    if (d < 0.0) return behind;
    return behind + max((sqrt(d) - b) / a, 0.0);
}

#endif
