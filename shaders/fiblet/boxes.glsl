// Boxes of fiblets in steps of their page's box.
const float kBoxStep = 1.0 / float(FIBLET_BOX_STEPS);

vec3 unpackCorner(uint bits) { return vec3(bits & 1023u, bits >> 10u & 1023u, bits >> 20u & 1023u) * kBoxStep; }

// A diagonal of the box and the distance from it within which the fiblet is, mm. \return  false: there is none
bool fibletDiagonal(FibletBox box, vec3 low, vec3 high, out vec3 from, out vec3 to, out float radius) {
    const uint n = box.high >> 30u;
    const bvec3 falls = bvec3(false, (box.low >> 30u & 1u) != 0u, (box.low >> 31u) != 0u);
    from = mix(low, high, falls);
    to = mix(high, low, falls);
    radius = distance(low, high) * exp2(-float(n + 2u));
    return n > 0u;
}

void fibletBoxCorners(FibletPage page, FibletBox box, out vec3 low, out vec3 high) {
    const vec3 extent = page.high - page.low;
    low = page.low + unpackCorner(box.low) * extent;
    high = page.low + unpackCorner(box.high) * extent;
}
