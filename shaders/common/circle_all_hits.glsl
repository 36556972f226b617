// All crossings of a ray with a spherical-harmonics glyph, in order: the march of circle_march.glsl carried on behind each hit.
// A walk knows on which side of the surface it is, and a crossing changes the side and nothing else does, so entries and exits
// alternate: a ray that begins outside has an even number of crossings, one that begins inside an odd number. It is outside at
// the sphere around the glyph, whatever rounding says. Behind a crossing the walk hops over what float32 cannot tell from it:
// two crossings of one lobe count as none (or as two) if between them G stays within kCircleSlack times the sum of amplitudes
// of +h or -h, that is if their angles differ by less than about 2 sqrt(2 kCircleSlack sum / |G''|). All others are found:
// steps are certified as in circle_march.glsl. Needs circle.py's output for the layout. Twin: server/reference/glyph_hits.
//
//   CircleWalk walk = circleWalk(F, h, radius, start, both_lobes);
//   CircleHit crossing;
//   while (circleNextCrossing(F, walk, crossing)) ... circleHitParameter(crossing, h, closest) ...
#ifndef RADIATA_COMMON_CIRCLE_ALL_HITS
#define RADIATA_COMMON_CIRCLE_ALL_HITS
#include "shaders/common/circle_march.glsl"

// Most crossings of one line: G = h and G = -h are trigonometric equations of degree k + 1, and for even bands the half circle
// has half of their roots.
#define CIRCLE_HITS_MAX ((SH_FULL + 1) * (2 * SH_K + 2))
const uint kCircleWalkLimit = 2048u;

struct CircleWalk {
    vec2 angle;
    vec2 last;  // where the ray leaves the sphere around the glyph
    float h;
    float slack;
    float m2, m3;  // CircleBounds
    int side;      // 1: inside a positive lobe, -1: inside a negative one, 0: outside
    uint steps;
    bool both_lobes;
    bool ended;   // no more crossings
    bool capped;  // gave up after kCircleWalkLimit steps (counted, reported, never seen)
};

// Which side of the surface a value of G is on.
int circleSide(float value, float h, bool both_lobes) { return value > h ? 1 : (both_lobes && value < -h ? -1 : 0); }

// The same parameters as circleMarch. After this, walk.side says where the ray begins.
CircleWalk circleWalk(const vec2 F[CIRCLE_HARMONICS + 1], float distance, float radius, vec2 start, bool both_lobes) {
    // As circleStart has it: angles tell how far along a line through the centre a ray begins.
    const float h = max(distance, 1e-18);
    const CircleBounds bounds = circleBounds(F);
    const float reach = min(radius, bounds.sum);
    CircleWalk walk = CircleWalk(vec2(1.0, 0.0), vec2(-1.0, 0.0), h, kCircleSlack * bounds.sum, bounds.m2, bounds.m3, 0, 0u,
                                 both_lobes, true, false);
    if (!(h < reach)) return walk;
    const float last_sine = h / reach;
    const vec2 first = vec2(sqrt((1.0 - last_sine) * (1.0 + last_sine)), last_sine);
    walk.last = vec2(-first.x, first.y);
    // By sines near the near side, where cosines are all 1.
    const bool begins_late = start.y >= 0.0 && (start.x <= 0.0 || start.y > first.y);
    walk.ended = begins_late && start.x < 0.0 && start.y <= last_sine;
    walk.angle = begins_late ? start : first;
    if (begins_late && !walk.ended) walk.side = circleSide(circleEvaluate(F, start).x * start.y, h, both_lobes);
    return walk;
}

vec2 circleTurned(vec2 angle, float turn) {
    const float t = 0.5 * turn, t2 = t * t;
    const vec2 turned = vec2((1.0 - t2) * angle.x - 2.0 * t * angle.y, 2.0 * t * angle.x + (1.0 - t2) * angle.y) / (1.0 + t2);
    return turned * (1.5 - 0.5 * dot(turned, turned));
}

// \param crossing  where; its value is that of the lobe entered or left, and walk.side tells which of the two (0 after an exit)
// \return whether there is one more crossing
bool circleNextCrossing(const vec2 F[CIRCLE_HARMONICS + 1], inout CircleWalk walk, out CircleHit crossing) {
    crossing = CircleHit(vec2(1.0, 0.0), 0.0, 0u, false);
    while (!walk.ended) {
        const bool at_end = walk.angle.x < 0.0 && walk.angle.y <= walk.last.y;
        if (at_end) {
            walk.ended = true;
            if (walk.side == 0) return false;
            crossing.angle = walk.last;
            crossing.value = float(walk.side) * max(abs(circleEvaluate(F, walk.last).x), 1e-30);
            walk.side = 0;
            return true;
        }
        const vec3 g = circleEvaluate(F, walk.angle);
        const float value = g.x * walk.angle.y;
        const float slope = g.y * walk.angle.y + g.x * walk.angle.x;
        const float curve = g.z * walk.angle.y + 2.0 * g.y * walk.angle.x - value;
        ++walk.steps;
        if (walk.steps > kCircleWalkLimit) {
            walk.capped = true;
            walk.angle = walk.last;
            continue;
        }
        // Height above the surface of the lobe ahead: outside that of each sign, inside the one that surrounds.
        const float lobe = walk.side != 0 ? float(walk.side) : (walk.both_lobes && value < 0.0 ? -1.0 : 1.0);
        const float outwards = walk.side != 0 ? -1.0 : 1.0;
        const float gap = outwards * (walk.h - lobe * value);  // left to go; negative: the surface was crossed
        const float approach = outwards * lobe * slope;
        if (gap < -walk.slack || (gap <= walk.slack && approach > 0.0)) {
            const float newton = approach != 0.0 ? clamp(gap / approach, -1e-3, 1e-3) : 0.0;
            const float turn = gap < -walk.slack ? newton : max(newton, 0.0);
            crossing.angle = normalize(vec2(walk.angle.x - turn * walk.angle.y, walk.angle.y + turn * walk.angle.x));
            const float amplitude = lobe * (g.x + turn * g.y);
            crossing.value = lobe * max(amplitude, 1e-30);
            walk.side = walk.side != 0 ? 0 : int(lobe);
            // On to where the value is beyond its slack again; the next root of this lobe is farther by the bound of G''.
            if (gap >= -walk.slack) {
                const float widest = 2.0 * sqrt(walk.slack / walk.m2);
                walk.angle = circleTurned(crossing.angle, clamp(2.0 * walk.slack / max(approach, 1e-30), 1e-7, widest));
            }
            return true;
        }
        float reach2 = circleReach(abs(gap), approach, walk.m2);
        // Outside, the lobes of the other sign are ahead too.
        const bool other = walk.side == 0 && walk.both_lobes;
        const float other_gap = walk.h + lobe * value;
        if (other) reach2 = min(reach2, circleReach(abs(other_gap), -approach, walk.m2));
        const float trust = 2.5 * reach2;
        const float rest = walk.m3 * trust * (1.0 / 3.0);
        const float bend = outwards * lobe * curve;
        float reach3 = circleReach(abs(gap), approach, bend + rest);
        if (other) reach3 = min(reach3, circleReach(abs(other_gap), -approach, rest - bend));
        walk.angle = circleTurned(walk.angle, clamp(max(reach2, min(trust, reach3)), 2e-7, 1.0));
    }
    return false;
}

// All crossings of the ray from `start` on, ascending.
// \param hits  angle and signed value of each; \return their number
// \param begins_inside  the first crossing is an exit
int circleAllHits(const vec2 F[CIRCLE_HARMONICS + 1], float h, float radius, vec2 start, bool both_lobes,
                  out vec3 hits[CIRCLE_HITS_MAX], out bool begins_inside, out uint steps, out bool capped) {
    CircleWalk walk = circleWalk(F, h, radius, start, both_lobes);
    begins_inside = walk.side != 0;
    int count = 0;
    CircleHit crossing;
    while (circleNextCrossing(F, walk, crossing)) {
        if (count < CIRCLE_HITS_MAX) hits[count++] = vec3(crossing.angle, crossing.value);
    }
    steps = walk.steps;
    capped = walk.capped;
    return count;
}

#endif
