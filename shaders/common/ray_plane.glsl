// The plane that a ray spans with a glyph's centre.
#ifndef RADIATA_COMMON_RAY_PLANE
#define RADIATA_COMMON_RAY_PLANE

struct RayPlane {
    vec3 e;         // unit, from the centre towards the ray, orthogonal to the ray's direction
    float h;        // distance of the ray from the centre
    float closest;  // ray parameter of the closest point
};

vec3 anyOrthogonal(vec3 d) {
    const vec3 axis = abs(d.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    return normalize(cross(d, axis));
}

// \param o  ray origin relative to the centre; \param d  unit direction
RayPlane rayPlane(vec3 o, vec3 d) {
    const float along = dot(o, d);
    vec3 p = o - along * d;
    p -= dot(p, d) * d;  // d is a unit vector up to rounding only
    const float h = length(p);
    return RayPlane(h > 0.0 ? p / h : anyOrthogonal(d), h, -along);
}

#endif
