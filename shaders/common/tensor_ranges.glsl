// First hit of a ray with the Reynolds glyph of a Cartesian tensor by ranges: pieces of the ray over which f - |p|^(n + 1) cannot vanish are
// left out, the others halved.
// Source: Hlawitschka et al., Sec. 5, after Knoll et al. 2009, Sec. 4 (rejection 0 not in F, bisection without a stack).
// A piece of the last depth is a hit if the surface is crossed between its ends; two crossings within one such piece are below the precision
// asked for. Ranges widen by kRangeSlack for float rounding, relative to the sum of |terms| at the piece's farthest point.
// Needs range_arithmetic.glsl, tensor.py's output and tensor_march.glsl, in this order.
#ifndef RADIATA_COMMON_TENSOR_RANGES
#define RADIATA_COMMON_TENSOR_RANGES

const float kRangeSlack = 2e-6;
const uint kRangeStepLimit = 8192u;

#define TENSOR_POWER_RANGE(Range)                                                       \
    Range tensorRadiusPower(Range square) {                                             \
        Range power = square;                                                           \
        for (int i = 1; i < (TENSOR_ORDER + 1) / 2; ++i) power = rangeMultiply(power, square); \
        if ((TENSOR_ORDER & 1) == 0) power = rangeMultiply(power, rangeRoot(square));   \
        return power;                                                                   \
    }
TENSOR_POWER_RANGE(Interval)
TENSOR_POWER_RANGE(Affine)

// f and |p|^(n + 1) over a piece of the ray, and the ranges of their difference and sum.
struct TensorPiece {
    Interval difference, sum;
};

#define TENSOR_PIECE(Range, name, ofLine)                                               \
    TensorPiece name(const float w[TENSOR_COUNT], TensorRay ray, float low, float high) { \
        const Range f = tensorRange(w, ofLine(ray.foot.x, ray.direction.x, low, high),  \
                                    ofLine(ray.foot.y, ray.direction.y, low, high),     \
                                    ofLine(ray.foot.z, ray.direction.z, low, high));    \
        Range square = rangeSquare(ofLine(0.0, 1.0, low, high));                        \
        square = rangeAdd(square, ofLine(ray.height * ray.height, 0.0, low, high));     \
        const Range power = tensorRadiusPower(square);                                  \
        return TensorPiece(rangeBounds(rangeAdd(f, rangeNegate(power))), rangeBounds(rangeAdd(f, power))); \
    }
TENSOR_PIECE(Interval, tensorIntervalPiece, intervalOfLine)
TENSOR_PIECE(Affine, tensorAffinePiece, affineOfLine)

bool rangeHoldsZero(Interval range, float slack) { return range.low <= slack && range.high >= -slack; }

// As tensorMarch(). \param affine  reduced affine forms in place of intervals
TensorHit tensorRangeMarch(const float w[TENSOR_COUNT], vec3 o, vec3 d, float t_min, bool both_lobes, TensorSettings settings,
                           bool affine) {
    const TensorRay ray = tensorRay(o, d, t_min);
    if (!(ray.begin < ray.end)) return TensorHit(0.0, 0.0, 0u, false);
    float terms = 1.0;
    for (int i = 0; i < TENSOR_COUNT; ++i) terms += abs(w[i]);
    const uint pieces = 1u << settings.depth;
    const float length = (ray.end - ray.begin) / float(pieces);
    uint steps = 0u;
    uint at = 0u;                 // in pieces of the last depth
    uint width = pieces;
    while (at < pieces && steps < kRangeStepLimit) {
        const float low = ray.begin + length * float(at), high = min(ray.begin + length * float(at + width), ray.end);
        TensorPiece piece;
        if (affine) piece = tensorAffinePiece(w, ray, low, high);
        else piece = tensorIntervalPiece(w, ray, low, high);
        ++steps;
        const float far = max(low * low, high * high) + ray.height * ray.height;
        float slack = kRangeSlack * terms;
        for (int i = 0; i < TENSOR_ORDER / 2; ++i) slack *= far;
        if ((TENSOR_ORDER & 1) != 0) slack *= sqrt(far);
        bool may_hit = rangeHoldsZero(piece.difference, slack);
        if (both_lobes) may_hit = may_hit || rangeHoldsZero(piece.sum, slack);
        if (may_hit && width > 1u) {
            width >>= 1u;
        } else {
            if (may_hit) {
                const float value_low = tensorInside(w, tensorPoint(ray, low), both_lobes);
                const float value_high = tensorInside(w, tensorPoint(ray, high), both_lobes);
                if ((value_low > 0.0) != (value_high > 0.0)) {
                    const float s = tensorRefine(w, ray, low, high, value_low, value_high, both_lobes, settings, steps);
                    return tensorHit(w, ray, s, steps);
                }
            }
            // The next piece is the largest one that begins here.
            at += width;
            width = at & (~at + 1u);
        }
    }
    TensorHit miss = TensorHit(0.0, 0.0, steps, steps >= kRangeStepLimit);
    return miss;
}

#endif
