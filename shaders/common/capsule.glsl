// First hit of a ray with a capsule: a cylinder with a ball at each end. Twin: server/reference/capsule.
// Source: quadratic of the cylinder, and of the ball at the end beyond which it is left; as in Han et al. 2019, Sec. 3.
#ifndef RADIATA_COMMON_CAPSULE
#define RADIATA_COMMON_CAPSULE

const float kCapsuleMissed = 3.4e38;

// First parameter of a ray's points within `radius` of a ball's centre at -offset.
float ballHit(vec3 offset, vec3 direction, float radius) {
    const float a = dot(direction, direction), b = dot(offset, direction);
    const vec3 across = offset - b / a * direction;
    const float root2 = (radius * radius - dot(across, across)) / a;
    if (root2 < 0.0) return kCapsuleMissed;
    return -b / a - sqrt(root2);
}

// \param origin, direction  of the ray; any length but zero
// \param start, along       one end of the axis and the way to the other, which may be zero
// \param nearest            least parameter; a ray that begins inside hits nothing
// \return parameter, or kCapsuleMissed. \param normal  unit, outwards; set where something is hit
float capsuleHit(vec3 origin, vec3 direction, vec3 start, vec3 along, float radius, float nearest, out vec3 normal) {
    // From the ray's point nearest to the capsule, so that far origins lose no digits.
    const float shift = dot(start + 0.5 * along - origin, direction) / dot(direction, direction);
    const vec3 offset = origin + shift * direction - start;
    const float from = nearest - shift;
    const float length2 = dot(along, along);
    normal = vec3(0.0);
    if (length2 > 0.0) {
        const vec3 d = direction - dot(direction, along) / length2 * along;
        const vec3 o = offset - dot(offset, along) / length2 * along;
        const float a = dot(d, d);
        if (a > 1e-12 * dot(direction, direction)) {
            const float side = ballHit(o, d, radius);
            const float place = dot(offset + side * direction, along) / length2;
            if (side < kCapsuleMissed && place >= 0.0 && place <= 1.0) {
                if (side < from) return kCapsuleMissed;
                normal = (o + side * d) / radius;
                return side + shift;
            }
        }
    }
    // Where a ray enters the second ball it may be inside the first, so what counts is the earlier entry.
    const float first = ballHit(offset, direction, radius), second = ballHit(offset - along, direction, radius);
    const float t = min(first, second);
    if (t < from || t == kCapsuleMissed) return kCapsuleMissed;
    normal = (offset + t * direction - (first <= second ? vec3(0.0) : along)) / radius;
    return t + shift;
}

// Whether a point is inside of a capsule, by at least 5e-4 radii, so that rays which come to it are sure to hit the capsule before.
// \param place  from an end of the axis \param along  from there to the other; zero: there is no capsule
bool insideCapsule(vec3 place, vec3 along, float radius) {
    const float length2 = dot(along, along);
    const vec3 away = place - clamp(dot(place, along) / max(length2, 1e-30), 0.0, 1.0) * along;
    return length2 > 0.0 && dot(away, away) < 0.999 * radius * radius;
}

#endif
