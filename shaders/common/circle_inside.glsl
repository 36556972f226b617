// Length of a ray inside of a spherical-harmonics glyph, from all its crossings: the march of circle_march.glsl carried on past
// each of them to the ray's end. Twin: server/reference/inside_length.
// Source: Peters et al. 2023, Sec. 4.3 ("the distance d that the ray travels through the glyph").
// The point at angle phi is inside where G = g sin(phi) > h (positive lobes) or G < -h (negative ones). Outside, a step cannot pass an
// entry; inside, it cannot pass an exit; so no part of the ray is missed but those that rounding cannot tell from touching:
// |G| - h within kCircleSlack times the sum of amplitudes, on a stretch of less than 2e-3 radians.
#ifndef RADIATA_COMMON_CIRCLE_INSIDE
#define RADIATA_COMMON_CIRCLE_INSIDE

struct CircleInside {
    float travelled;  // inside, same unit as h
    uint steps;
    bool capped;  // gave up after kCircleStepLimit steps; the length counts up to there
};

// Angle of a crossing near `angle`, from G's gap to it and the rate at which the gap closes, as the ray's parameter.
float circleCrossing(vec3 g, vec2 angle, float gap, float towards, float h, float closest) {
    const float turn = towards != 0.0 ? clamp(gap / towards, -1e-3, 1e-3) : 0.0;
    const vec2 turned = normalize(vec2(angle.x - turn * angle.y, angle.y + turn * angle.x));
    return circleHitParameter(CircleHit(turned, g.x + turn * g.y, 0u, false), h, closest);
}

// \param h, closest  of the ray, see rayPlane; \param radius  certified largest |f| (of the lobes that count)
// \param begin, end  parameters between which the length counts
CircleInside circleInside(const vec2 F[CIRCLE_HARMONICS + 1], float h, float closest, float radius, float begin, float end,
                          bool both_lobes) {
    CircleInside result = CircleInside(0.0, 0u, false);
    const CircleBounds bounds = circleBounds(F);
    const float reach = min(radius, bounds.sum);
    if (!(h < reach) || !(begin < end)) return result;
    const float last_sine = h / reach;
    const vec2 first = vec2(sqrt((1.0 - last_sine) * (1.0 + last_sine)), last_sine);
    const vec2 start = circleStart(closest, h, begin), stop = circleStart(closest, h, end);
    // Behind the sphere, or not yet in it.
    if (start.x < 0.0 && start.y <= last_sine) return result;
    if (stop.x > 0.0 && stop.y <= last_sine) return result;
    const bool begins_late = start.x < first.x;
    const bool ends_early = !(stop.x < 0.0 && stop.y <= last_sine);
    const vec2 last = ends_early ? stop : vec2(-first.x, first.y);
    vec2 angle = begins_late ? start : first;
    const float slack = kCircleSlack * bounds.sum;
    float lobe = 0.0;  // that the ray is in: 1, -1, or 0 outside
    float entered = begin;
    bool at_end = false, more = true;
    while (more) {
        const vec3 g = circleEvaluate(F, angle);
        const float value = g.x * angle.y;
        const float slope = g.y * angle.y + g.x * angle.x;
        const float curve = g.z * angle.y + 2.0 * g.y * angle.x - value;
        if (result.steps == 0u && begins_late) {
            lobe = value > h ? 1.0 : both_lobes && value < -h ? -1.0 : 0.0;
        } else if (lobe == 0.0) {
            // An entry is reached, or was passed by rounding. At the end a ray that has not entered does not.
            const float side = both_lobes && g.x < 0.0 ? -1.0 : 1.0;
            const float gap = h - side * value, towards = side * slope;
            if (!at_end && (gap < 0.0 || (gap <= slack && towards > 0.0 && side * g.x > 0.0))) {
                lobe = side;
                entered = max(circleCrossing(g, angle, gap, towards, h, closest), begin);
            }
        } else {
            const float gap = lobe * value - h, towards = -lobe * slope;
            const bool out_at_end = at_end && !ends_early;  // nothing of the glyph is beyond its sphere
            if (gap < 0.0 || (gap <= slack && towards > 0.0) || out_at_end) {
                const float left = circleCrossing(g, angle, gap, towards, h, closest);
                result.travelled += max(min(left, end) - entered, 0.0);
                lobe = 0.0;
            }
        }
        ++result.steps;
        result.capped = !at_end && result.steps == kCircleStepLimit;
        more = !at_end && !result.capped;
        // The next crossing of the side that the ray is on now; what is within rounding of the last one is behind.
        float reach2, trust, reach3;
        if (lobe == 0.0) {
            reach2 = circleReach(max(h - value, 0.0), slope, bounds.m2);
            if (both_lobes) reach2 = min(reach2, circleReach(max(h + value, 0.0), -slope, bounds.m2));
            trust = 2.5 * reach2;
            const float rest = bounds.m3 * trust * (1.0 / 3.0);
            reach3 = circleReach(max(h - value, 0.0), slope, curve + rest);
            if (both_lobes) reach3 = min(reach3, circleReach(max(h + value, 0.0), -slope, -curve + rest));
        } else {
            const float gap = max(lobe * value - h, 0.0);
            reach2 = circleReach(gap, -lobe * slope, bounds.m2);
            trust = 2.5 * reach2;
            reach3 = circleReach(gap, -lobe * slope, -lobe * curve + bounds.m3 * trust * (1.0 / 3.0));
        }
        const float turn = 0.5 * clamp(max(reach2, min(trust, reach3)), 1e-6, 1.0);
        const float t2 = turn * turn;
        angle = vec2((1.0 - t2) * angle.x - 2.0 * turn * angle.y, 2.0 * turn * angle.x + (1.0 - t2) * angle.y) / (1.0 + t2);
        angle *= 1.5 - 0.5 * dot(angle, angle);
        // Past the last angle: the sine of the difference, and the whole half circle is past at the latest.
        at_end = angle.y * last.x - angle.x * last.y >= 0.0 || angle.y <= 0.0;
        if (at_end) angle = last;
    }
    if (lobe != 0.0) result.travelled += max(end - entered, 0.0);
    return result;
}

#endif
