// First root of a trilinear cell's value along a chord: a cubic in a parameter that runs from 0 where the ray enters the cell to 1
// where it leaves. The interval is split at the roots of the derivative, so that no pair of roots hides between two ends of equal
// sign, and the first piece that changes sign is searched by Newton's method, kept inside the bracket by bisection.
// Error below 2e-5 cells for 99.99 % of random chords (tests/gpu/functions/cubic_test.cpp). Twin: server/reference/cubic.
// Sources: Parker et al. 1998 (the cubic); Marmitt et al. 2004, Sec. 4 (split at the derivative's roots).
#ifndef RADIATA_COMMON_CUBIC
#define RADIATA_COMMON_CUBIC

// Corners in the order x fastest, then y, then z, less the isovalue.
// Weights are such that a chord's end on a face gets the same bits from both cells that share it: the other corners' weights are
// exactly 0, and values of one sign never give the other.
float cellValue(float c[8], vec3 p) {
    precise vec3 q = 1.0 - p;
    precise float y00 = (c[0] * q.x + c[1] * p.x) * q.y + (c[2] * q.x + c[3] * p.x) * p.y;
    precise float y01 = (c[4] * q.x + c[5] * p.x) * q.y + (c[6] * q.x + c[7] * p.x) * p.y;
    precise float value = y00 * q.z + y01 * p.z;
    return value;
}

vec3 cellGradient(float c[8], vec3 p) {
    const vec3 q = 1.0 - p;
    return vec3(((c[1] - c[0]) * q.y + (c[3] - c[2]) * p.y) * q.z + ((c[5] - c[4]) * q.y + (c[7] - c[6]) * p.y) * p.z,
                ((c[2] - c[0]) * q.x + (c[3] - c[1]) * p.x) * q.z + ((c[6] - c[4]) * q.x + (c[7] - c[5]) * p.x) * p.z,
                ((c[4] - c[0]) * q.x + (c[5] - c[1]) * p.x) * q.y + ((c[6] - c[2]) * q.x + (c[7] - c[3]) * p.x) * p.y);
}

// Coefficients of powers of u along from + u * (to - from). The values at both ends are given and met exactly: what rounding leaves
// over goes into the linear term.
vec4 cellCubic(float c[8], vec3 from, vec3 to, float value_from, float value_to) {
    const vec3 d = to - from;
    const float kxy = (c[3] - c[2]) - (c[1] - c[0]), kyz = (c[6] - c[4]) - (c[2] - c[0]), kzx = (c[5] - c[4]) - (c[1] - c[0]);
    const float kxyz = ((c[7] - c[6]) - (c[5] - c[4])) - kxy;
    const float dxy = d.x * d.y, dyz = d.y * d.z, dzx = d.z * d.x;
    const float quadratic =
        kxy * dxy + kyz * dyz + kzx * dzx + kxyz * (from.x * dyz + from.y * dzx + from.z * dxy);
    const float cubic = kxyz * dxy * d.z;
    return vec4(value_from, (value_to - value_from) - (quadratic + cubic), quadratic, cubic);
}

float cubicValue(vec4 k, float u) { return ((k.w * u + k.z) * u + k.y) * u + k.x; }

// The root between low and high, at which the values have different signs; the value is 0 or positive at `low` if low_inside.
float bracketedCubicRoot(vec4 k, float low, float high, bool low_inside) {
    const float value_low = cubicValue(k, low), value_high = cubicValue(k, high);
    float u = mix(low, high, clamp(value_low / (value_low - value_high), 0.0, 1.0));
    for (int i = 0; i < 10; ++i) {
        const float value = cubicValue(k, u);
        if ((value >= 0.0) == low_inside) low = u;
        else high = u;
        const float slope = (3.0 * k.w * u + 2.0 * k.z) * u + k.y;
        const float change = value / slope;
        // First whether it has converged: a root at the very end of its bracket would be thrown into the middle.
        if (abs(change) < 1e-7) return clamp(u - change, 0.0, 1.0);
        const float next = u - change;
        u = next > low && next < high ? next : 0.5 * (low + high);
    }
    return u;
}

// The least u in [0, 1] from which on the value has the other sign than at u = 0, where 0 counts as positive; -1: none.
// Whether k.x is the value at 0, and the sum of the coefficients that at 1, is what the caller made sure of.
// \param value_to  at 1, as the caller knows it
float firstCubicRoot(vec4 k, float value_to) {
    const bool inside = k.x >= 0.0;
    // Whatever the unit of the samples, squares stay within range.
    const float largest = max(max(abs(k.x), abs(k.y)), max(abs(k.z), abs(k.w)));
    if (largest > 0.0) k /= largest;
    // Roots of the derivative 3 w u^2 + 2 z u + y, by the form without cancellation.
    float first = 1.0, second = 1.0;
    const float discriminant = k.z * k.z - 3.0 * k.w * k.y;
    if (discriminant > 0.0) {
        const float q = -(k.z + (k.z < 0.0 ? -sqrt(discriminant) : sqrt(discriminant)));
        const float a = q / (3.0 * k.w), b = k.y / q;  // an infinite one is no root; NaN fails all comparisons
        const float a_in = a > 0.0 && a < 1.0 ? a : 1.0, b_in = b > 0.0 && b < 1.0 ? b : 1.0;
        first = min(a_in, b_in);
        second = max(a_in, b_in);
    }
    if ((cubicValue(k, first) >= 0.0) != inside && first < 1.0) return bracketedCubicRoot(k, 0.0, first, inside);
    if ((cubicValue(k, second) >= 0.0) != inside && second < 1.0) return bracketedCubicRoot(k, first, second, inside);
    if ((value_to >= 0.0) != inside) return bracketedCubicRoot(k, second < 1.0 ? second : first < 1.0 ? first : 0.0, 1.0, inside);
    return -1.0;
}

#endif
