// Boxes of fiblets in steps of their page's box.
const float kBoxStep = 1.0 / float(FIBLET_BOX_STEPS);

vec3 unpackCorner(uint bits) { return vec3(bits & 1023u, bits >> 10u & 1023u, bits >> 20u & 1023u) * kBoxStep; }

void fibletBoxCorners(FibletPage page, FibletBox box, out vec3 low, out vec3 high) {
    const vec3 extent = page.high - page.low;
    low = page.low + unpackCorner(box.low) * extent;
    high = page.low + unpackCorner(box.high) * extent;
}
