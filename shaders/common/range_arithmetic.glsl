// Interval arithmetic and reduced affine arithmetic: where the value of an expression lies when its variables lie in ranges.
// Sources: Hlawitschka et al., Sec. 5; Moore 1966 (intervals); Comba and Stolfi 1993 (affine forms), reduced to one shared symbol and one
// remainder as in Knoll et al. 2009, Sec. 3.
// An Affine is mid + slope e + [-rest, rest], where e in [-1, 1] is the same for all forms: the place along the piece of the ray.
// Rounding is to nearest, not outward: who relies on the bounds widens them (tensor_ranges.glsl).
#ifndef RADIATA_COMMON_RANGE_ARITHMETIC
#define RADIATA_COMMON_RANGE_ARITHMETIC

struct Interval {
    float low, high;
};
struct Affine {
    float mid, slope, rest;  // rest >= 0
};

// The points of a + b t for t in [low, high].
Interval intervalOfLine(float a, float b, float low, float high) {
    const float first = a + b * low, second = a + b * high;
    return Interval(min(first, second), max(first, second));
}
Interval rangeAdd(Interval a, Interval b) { return Interval(a.low + b.low, a.high + b.high); }
Interval rangeNegate(Interval a) { return Interval(-a.high, -a.low); }
Interval rangeScale(float factor, Interval a) {
    const float low = factor * a.low, high = factor * a.high;
    return Interval(min(low, high), max(low, high));
}
Interval rangeMultiply(Interval a, Interval b) {
    const vec4 products = vec4(a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high);
    return Interval(min(min(products.x, products.y), min(products.z, products.w)),
                    max(max(products.x, products.y), max(products.z, products.w)));
}
Interval rangeSquare(Interval a) {
    const float low = a.low * a.low, high = a.high * a.high;
    return Interval(a.low <= 0.0 && a.high >= 0.0 ? 0.0 : min(low, high), max(low, high));
}
Interval rangeRoot(Interval a) { return Interval(sqrt(max(a.low, 0.0)), sqrt(max(a.high, 0.0))); }
Interval rangeBounds(Interval a) { return a; }

// The points of a + b t for t in [low, high]: exact.
Affine affineOfLine(float a, float b, float low, float high) {
    return Affine(a + b * 0.5 * (low + high), b * 0.5 * (high - low), 0.0);
}
Affine rangeAdd(Affine a, Affine b) { return Affine(a.mid + b.mid, a.slope + b.slope, a.rest + b.rest); }
Affine rangeNegate(Affine a) { return Affine(-a.mid, -a.slope, a.rest); }
Affine rangeScale(float factor, Affine a) { return Affine(factor * a.mid, factor * a.slope, abs(factor) * a.rest); }
Affine rangeMultiply(Affine a, Affine b) {
    const float radius_a = abs(a.slope) + a.rest, radius_b = abs(b.slope) + b.rest;
    return Affine(a.mid * b.mid, a.mid * b.slope + b.mid * a.slope,
                  abs(a.mid) * b.rest + abs(b.mid) * a.rest + radius_a * radius_b);
}
// Tighter than the product: e^2 lies in [0, 1], so half of it is known.
Affine rangeSquare(Affine a) {
    const float half_square = 0.5 * a.slope * a.slope;
    return Affine(a.mid * a.mid + half_square, 2.0 * a.mid * a.slope,
                  half_square + 2.0 * (abs(a.mid) + abs(a.slope)) * a.rest + a.rest * a.rest);
}
Interval rangeBounds(Affine a) {
    const float radius = abs(a.slope) + a.rest;
    return Interval(a.mid - radius, a.mid + radius);
}
// Of a value that is never negative, though its bounds may be. The root is concave: it lies between the chord and the parallel tangent.
Affine rangeRoot(Affine a) {
    const Interval bounds = rangeBounds(a);
    const float low = sqrt(max(bounds.low, 0.0)), high = sqrt(max(bounds.high, 0.0));
    if (!(low + high > 0.0)) return Affine(0.0, 0.0, 0.0);
    const float alpha = 1.0 / (low + high);
    // Chord: alpha u + low high alpha; tangent: alpha u + (low + high) / 4.
    const float chord = low * high * alpha, tangent = 0.25 * (low + high);
    return Affine(alpha * a.mid + 0.5 * (chord + tangent), alpha * a.slope, alpha * a.rest + 0.5 * (tangent - chord));
}

#endif
