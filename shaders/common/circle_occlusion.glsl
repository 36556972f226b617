// Whether a glyph stands in a ray's way: the march of circle_march.glsl, stopped at the first point inside, for rays that begin outside of
// the glyph or on its surface. Twin: server/reference/visibility (glyph_hits).
// No offset keeps a surface from shadowing itself. A ray that begins on the glyph gets the h that puts its first point exactly on the
// surface, h = |g| sin phi at its own angle, and the sign of the slope there says whether it leaves or enters. So nothing thin is
// jumped over, and the test is the same at every scale. What remains is stated in parts of the sum of amplitudes: a ray that approaches
// the surface counts as inside from 3e-7 before it, one that leaves is outside from 2.4e-6 within it, as G is known to that only.
#ifndef RADIATA_COMMON_CIRCLE_OCCLUSION
#define RADIATA_COMMON_CIRCLE_OCCLUSION

const float kInsideSlack = 2.4e-6;

struct CircleOcclusion {
    bool blocked;
    bool capped;  // gave up after kCircleStepLimit steps
};

// h of a ray that begins on the glyph's surface, at its angle. \param start  (cos, sin)
float circleSurfaceHeight(const vec2 F[CIRCLE_HARMONICS + 1], vec2 start) { return abs(circleEvaluate(F, start).x) * start.y; }

// \param h, radius  as for circleMarch
// \param start, end (cos, sin) of the angles where the ray begins and ends; (-1, 0): it does not end
CircleOcclusion circleOcclusion(const vec2 F[CIRCLE_HARMONICS + 1], float h, float radius, vec2 start, vec2 end, bool both_lobes) {
    CircleOcclusion result = CircleOcclusion(false, false);
    const CircleBounds bounds = circleBounds(F);
    const float reach = min(radius, bounds.sum);
    if (!(h < reach)) return result;
    const float last_sine = h / reach;
    const float first = sqrt((1.0 - last_sine) * (1.0 + last_sine));
    vec2 angle = start.x < first ? start : vec2(first, last_sine);
    const float last = max(-first, end.x);  // angles grow as cosines fall
    const float slack = kCircleSlack * bounds.sum, inside = -kInsideSlack * bounds.sum;
    uint steps = 0u;
    bool more = angle.x > last;
    while (more) {
        const vec3 g = circleEvaluate(F, angle);
        const float value = g.x * angle.y;
        const float slope = g.y * angle.y + g.x * angle.x;
        const float curve = g.z * angle.y + 2.0 * g.y * angle.x - value;
        const float up = h - value, down = h + value;
        const bool in_up = up < inside || (up <= slack && slope >= 0.0 && g.x > 0.0);
        const bool in_down = both_lobes && (down < inside || (down <= slack && slope <= 0.0 && g.x < 0.0));
        ++steps;
        if (in_up || in_down) {
            result.blocked = true;
            more = false;
        } else {
            const float gap_up = max(up, 0.0), gap_down = max(down, 0.0);
            float reach2 = circleReach(gap_up, slope, bounds.m2);
            if (both_lobes) reach2 = min(reach2, circleReach(gap_down, -slope, bounds.m2));
            const float trust = 2.5 * reach2;
            const float rest = bounds.m3 * trust * (1.0 / 3.0);
            float reach3 = circleReach(gap_up, slope, curve + rest);
            if (both_lobes) reach3 = min(reach3, circleReach(gap_down, -slope, -curve + rest));
            const float turn = 0.5 * clamp(max(reach2, min(trust, reach3)), 1e-6, 1.0);
            const float t2 = turn * turn;
            angle = vec2((1.0 - t2) * angle.x - 2.0 * turn * angle.y, 2.0 * turn * angle.x + (1.0 - t2) * angle.y) / (1.0 + t2);
            angle *= 1.5 - 0.5 * dot(angle, angle);
            more = angle.x > last && angle.y > 0.0 && steps < kCircleStepLimit;
        }
    }
    result.capped = !result.blocked && steps >= kCircleStepLimit;
    return result;
}

#endif
