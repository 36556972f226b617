// First hit of a ray with a spherical-harmonics glyph: certified march on the great circle of the ray's plane.
// In the plane of ray and centre, with phi measured from the near side, dir(phi) = -cos(phi) d + sin(phi) e and a point of the ray at angle
// phi has distance h / sin(phi), h being the ray's distance from the centre. Hits are the solutions of
//   G(phi) = g(phi) sin(phi) = +h (positive lobes) or -h (negative ones),  0 < phi < pi,  g = f on the circle,
// in any parity of bands. Steps come from Taylor bounds of second and third order with exact bounds of G'' and G''', so in exact arithmetic no
// root is stepped over; in float32 a root counts as reached within kCircleSlack times the sum of amplitudes.
// Needs circle.py's output for the layout: CIRCLE_HARMONICS, CIRCLE_STRIDE. Twin: server/reference/glyph_hits (dense sampling, bisection).
#ifndef RADIATA_COMMON_CIRCLE_MARCH
#define RADIATA_COMMON_CIRCLE_MARCH

const float kCircleSlack = 3e-7;
const uint kCircleStepLimit = 256u;

struct CircleHit {
    vec2 angle;   // (cos phi, sin phi)
    float value;  // g there, signed; 0: no hit
    uint steps;
    bool capped;  // gave up after kCircleStepLimit steps (counted, reported, never seen)
};

struct CircleBounds {
    float sum;  // >= |g|
    float m2;   // >= |G''|
    float m3;   // >= |G'''|
};

CircleBounds circleBounds(const vec2 F[CIRCLE_HARMONICS + 1]) {
    CircleBounds bounds = CircleBounds(abs(F[0].x), 0.0, 0.0);
    for (int h = 1; h <= CIRCLE_HARMONICS; ++h) bounds.sum += length(F[h]);
#if SH_FULL
    for (int m = 1; m <= CIRCLE_HARMONICS + 1; ++m) {
        vec2 difference = m == 1 ? vec2(2.0 * F[0].x, 0.0) : F[m - 1];
        if (m + 1 <= CIRCLE_HARMONICS) difference -= F[m + 1];
        const float q = float(m);
        const float amplitude = 0.5 * length(difference) * q * q;
        bounds.m2 += amplitude;
        bounds.m3 += amplitude * q;
    }
#else
    for (int h = 0; h <= CIRCLE_HARMONICS; ++h) {
        vec2 difference = h == 0 ? vec2(2.0 * F[0].x, 0.0) : F[h];
        if (h < CIRCLE_HARMONICS) difference -= F[h + 1];
        const float q = float(2 * h + 1);
        const float amplitude = 0.5 * length(difference) * q * q;
        bounds.m2 += amplitude;
        bounds.m3 += amplitude * q;
    }
#endif
    return bounds;
}

// (g, g', g'') at (cos phi, sin phi): one complex Horner scheme for value and derivatives.
vec3 circleEvaluate(const vec2 F[CIRCLE_HARMONICS + 1], vec2 angle) {
#if SH_FULL
    const vec2 z = angle;
#else
    const vec2 z = vec2(angle.x * angle.x - angle.y * angle.y, 2.0 * angle.x * angle.y);
#endif
    vec2 p = vec2(F[CIRCLE_HARMONICS].x, -F[CIRCLE_HARMONICS].y), p1 = vec2(0.0), p2 = vec2(0.0);
    for (int h = CIRCLE_HARMONICS - 1; h >= 0; --h) {
        p2 = vec2(p2.x * z.x - p2.y * z.y, p2.x * z.y + p2.y * z.x) + p1;
        p1 = vec2(p1.x * z.x - p1.y * z.y, p1.x * z.y + p1.y * z.x) + p;
        p = vec2(p.x * z.x - p.y * z.y + F[h].x, p.x * z.y + p.y * z.x - F[h].y);
    }
    const vec2 w = vec2(p1.x * z.x - p1.y * z.y, p1.x * z.y + p1.y * z.x);
    const vec2 v = vec2(p2.x * z.x - p2.y * z.y, p2.x * z.y + p2.y * z.x);
    const float curve = w.x + 2.0 * (v.x * z.x - v.y * z.y);
    return vec3(p.x, -CIRCLE_STRIDE * w.y, -CIRCLE_STRIDE * CIRCLE_STRIDE * curve);
}

// Smallest x >= 0 at which gap - slope x - curve x^2 / 2 can vanish, for gap >= 0; infinity if never. Free of cancellation.
float circleReach(float gap, float slope, float curve) {
    const float discriminant = slope * slope + 2.0 * curve * gap;
    const float root = sqrt(max(discriminant, 0.0));
    const float numerator = slope >= 0.0 ? 2.0 * gap : root - slope;
    const float denominator = slope >= 0.0 ? slope + root : curve;
    return discriminant >= 0.0 && denominator > 0.0 ? numerator / denominator : 1e30;
}

// \param h      distance of the ray from the centre, >= 0, in units of amplitude
// \param radius certified largest |f| (of the lobes that count)
// \param start  (cos, sin) of the angle at which the ray begins, or sin < 0 if it begins outside of the glyph's sphere
// Works from inside too: then the first crossing is where the ray leaves.
CircleHit circleMarch(const vec2 F[CIRCLE_HARMONICS + 1], float h, float radius, vec2 start, bool both_lobes) {
    CircleHit hit = CircleHit(vec2(1.0, 0.0), 0.0, 0u, false);
    const CircleBounds bounds = circleBounds(F);
    const float reach = min(radius, bounds.sum);
    if (!(h < reach)) return hit;
    const float last_sine = h / reach;
    const vec2 first = vec2(sqrt((1.0 - last_sine) * (1.0 + last_sine)), last_sine);
    vec2 angle = first;
    // The ray may begin behind that point: angles grow from the near side, so a smaller cosine is later.
    const bool begins_late = start.y >= 0.0 && start.x < angle.x;
    if (begins_late && start.x < 0.0 && start.y <= last_sine) return hit;
    if (begins_late) angle = start;
    const float slack = kCircleSlack * bounds.sum;
    uint steps = 0u;
    // Which side of +h and -h the ray was on. Rounding of a steep G can carry a step over a root by more than the slack; a change of side
    // is then the hit. On the sphere around the glyph the ray is outside whatever rounding says.
    bool was_above = false, was_below = false;
    // A ray that is inside before it leaves the sphere has its hit there at the latest, though rounding may carry it past both.
    bool more = true, at_end = false;
    while (more) {
        const vec3 g = circleEvaluate(F, angle);
        const float value = g.x * angle.y;
        const float slope = g.y * angle.y + g.x * angle.x;
        const float curve = g.z * angle.y + 2.0 * g.y * angle.x - value;
        // Gap to +h, and to -h if negative lobes count; measured from whichever side the ray is on.
        const float up = at_end ? max(h - value, 0.0) : h - value, up_side = up >= 0.0 ? 1.0 : -1.0;
        const float down = at_end ? max(h + value, 0.0) : h + value, down_side = down >= 0.0 ? 1.0 : -1.0;
        if (steps == 0u && begins_late) {
            was_above = up < 0.0;
            was_below = down < 0.0;
        }
        const bool crossed_up = (up < 0.0) != was_above;
        const bool crossed_down = both_lobes && (down < 0.0) != was_below;
        was_above = up < 0.0;
        was_below = down < 0.0;
        const bool at_up = crossed_up || (abs(up) <= slack && g.x > 0.0 && !at_end);
        const bool at_down = crossed_down || (both_lobes && abs(down) <= slack && g.x < 0.0 && !at_end);
        ++steps;
        if (at_up || at_down) {
            // One Newton step towards the root; backwards only if it was crossed.
            const float gap = at_up ? abs(up) : abs(down);
            const float towards = at_up ? up_side * slope : -down_side * slope;
            const float newton = towards != 0.0 ? clamp(gap / towards, -1e-3, 1e-3) : 0.0;
            const float turn = crossed_up || crossed_down ? newton : max(newton, 0.0);
            hit.angle = normalize(vec2(angle.x - turn * angle.y, angle.y + turn * angle.x));
            hit.value = g.x + turn * g.y;
            hit.value = at_up ? max(hit.value, 1e-30) : min(hit.value, -1e-30);
            more = false;
        } else {
            float reach2 = circleReach(abs(up), up_side * slope, bounds.m2);
            if (both_lobes) reach2 = min(reach2, circleReach(abs(down), -down_side * slope, bounds.m2));
            const float trust = 2.5 * reach2;
            const float rest = bounds.m3 * trust * (1.0 / 3.0);
            float reach3 = circleReach(abs(up), up_side * slope, up_side * curve + rest);
            if (both_lobes) reach3 = min(reach3, circleReach(abs(down), -down_side * slope, -down_side * curve + rest));
            const float turn = 0.5 * clamp(max(reach2, min(trust, reach3)), 1e-7, 1.0);
            const float t2 = turn * turn;
            angle = vec2((1.0 - t2) * angle.x - 2.0 * turn * angle.y, 2.0 * turn * angle.x + (1.0 - t2) * angle.y) / (1.0 + t2);
            angle *= 1.5 - 0.5 * dot(angle, angle);
            at_end = angle.x < 0.0 && angle.y <= last_sine;
            if (at_end) angle = vec2(-first.x, first.y);
            more = steps < kCircleStepLimit && (!at_end || was_above || (both_lobes && was_below));
        }
    }
    hit.steps = steps;
    hit.capped = hit.value == 0.0 && steps >= kCircleStepLimit;
    return hit;
}

// Where a ray begins, for circleMarch. \param closest  parameter of the ray's closest point to the centre
// 1e-18 has a square that float32 can hold: a ray that begins in the centre itself has an angle too.
vec2 circleStart(float closest, float h, float t_min) { return normalize(vec2(closest - t_min, max(h, 1e-18))); }

// A ray through the centre that begins outside, behind a lobe, is within the march's slack of that lobe's end.
bool circleHitCounts(CircleHit hit, float t, float t_min, float radius) {
    return hit.value != 0.0 && t >= t_min - 1e-4 * radius;
}

// Ray parameter of a hit, without cancellation near the centre. \param closest  parameter of the ray's closest point to the centre
float circleHitParameter(CircleHit hit, float h, float closest) {
    return hit.angle.y < 0.5 ? closest - abs(hit.value) * hit.angle.x : closest - h * hit.angle.x / hit.angle.y;
}

#endif
