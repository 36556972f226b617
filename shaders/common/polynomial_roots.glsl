// Real roots of a polynomial in an interval by bracketed Newton bisection: between two roots of its derivative a polynomial is
// monotonic, so the roots of all derivatives are found in turn, from the quadratic one upwards.
// Source: Yuksel 2022, High-performance polynomial root finding for graphics, as used by Peters et al. 2023, Sec. 3.5.
// Needs POLYNOMIAL_DEGREE and POLYNOMIAL_EACH_DERIVATIVE (generate/polynomial.py), and
//   const bool kPolynomialStopOnBracket;  (a specialisation constant) how an iteration ends:
//     false: when two iterates are closer than the tolerance, 2e-4 of the search interval's half (the paper's rule)
//     true:  when the bracket is narrower than 1e-6 max(1, |u|); steps that do not halve their predecessor give way to bisection
// The loop over derivatives is written out, so that coefficients are registers (3 times faster on a CPU driver, which does not unroll
// it by itself); the loops over intervals are not (as fast, and compiles 20 times faster).
#ifndef RADIATA_COMMON_POLYNOMIAL_ROOTS
#define RADIATA_COMMON_POLYNOMIAL_ROOTS
#extension GL_EXT_control_flow_attributes : require

const int kPolynomialIterationLimit = 90;
const float kPolynomialBracketWidth = 1e-6;

float polynomialValue(const float c[POLYNOMIAL_DEGREE + 1], int degree, float u) {
    float value = c[degree];
    [[unroll]] for (int i = degree - 1; i >= 0; --i) value = value * u + c[i];
    return value;
}

// The root in [low, high], where the polynomial changes its sign once. Overflow is harmless: it leaves the sign right, and a step
// that is not a number is replaced by bisection.
float polynomialBracketedRoot(const float c[POLYNOMIAL_DEGREE + 1], int degree, float low, float high, bool low_positive,
                              float tolerance, inout uint steps) {
    float u = 0.5 * (low + high);
    float last_step = high - low;
    for (int iteration = 0; iteration < kPolynomialIterationLimit; ++iteration) {
        float value = c[degree], slope = 0.0;
        [[unroll]] for (int i = degree - 1; i >= 0; --i) {
            slope = slope * u + value;
            value = value * u + c[i];
        }
        ++steps;
        const bool root_above = (value > 0.0) == low_positive;
        low = root_above ? u : low;
        high = root_above ? high : u;
        float next = u - value / slope;
        bool done;
        if (kPolynomialStopOnBracket) {
            const float width = kPolynomialBracketWidth * max(1.0, abs(u));
            // Newton's method closes in from one side; a step as long as the tolerance moves the other end of the bracket.
            if (abs(next - u) < 0.5 * width) next = root_above ? u + 0.5 * width : u - 0.5 * width;
            if (!(next > low && next < high && abs(next - u) <= max(0.5 * abs(last_step), width))) next = 0.5 * (low + high);
            done = high - low <= width;
            last_step = next - u;
        } else {
            if (!(next >= low && next <= high)) next = 0.5 * (low + high);
            done = abs(next - u) < tolerance;
        }
        u = next;
        if (done) break;
    }
    return u;
}

// From the roots of one derivative to those of the next lower one, of the given degree. Derivatives are divided by the factorials of
// their orders, so that each has a coefficient of f as its constant term.
void polynomialDerivativeRoots(const float f[POLYNOMIAL_DEGREE + 1], int degree, float first, float last, float tolerance,
                               inout float c[POLYNOMIAL_DEGREE + 1], inout float roots[POLYNOMIAL_DEGREE], inout int count,
                               inout uint steps) {
    const float order = float(POLYNOMIAL_DEGREE + 1 - degree);
    [[unroll]] for (int i = degree; i > 0; --i) c[i] = c[i - 1] * (order / float(i));
    c[0] = f[POLYNOMIAL_DEGREE - degree];
    int found = 0;
    float low = first;
    bool low_positive = polynomialValue(c, degree, first) > 0.0;
    for (int i = 0; i <= count; ++i) {
        const float high = i < count ? roots[i] : last;
        const bool high_positive = polynomialValue(c, degree, high) > 0.0;
        if (high_positive != low_positive) {
            // found <= i: what is overwritten has been read.
            roots[found++] = polynomialBracketedRoot(c, degree, low, high, low_positive, tolerance, steps);
        }
        low = high;
        low_positive = high_positive;
    }
    count = found;
}

// Roots of the first derivative in (first, last), ascending. \return their number
int polynomialExtrema(const float f[POLYNOMIAL_DEGREE + 1], float first, float last, float tolerance,
                      out float roots[POLYNOMIAL_DEGREE], inout uint steps) {
    float c[POLYNOMIAL_DEGREE + 1];
    c[0] = f[POLYNOMIAL_DEGREE - 2];
    c[1] = float(POLYNOMIAL_DEGREE - 1) * f[POLYNOMIAL_DEGREE - 1];
    c[2] = 0.5 * float(POLYNOMIAL_DEGREE * (POLYNOMIAL_DEGREE - 1)) * f[POLYNOMIAL_DEGREE];
    int count = 0;
    const float discriminant = c[1] * c[1] - 4.0 * c[0] * c[2];
    if (discriminant >= 0.0) {
        const float q = -0.5 * (c[1] + (c[1] < 0.0 ? -sqrt(discriminant) : sqrt(discriminant)));
        const float one = q / c[2], other = c[0] / q;
        const float lower = min(one, other), upper = max(one, other);
        if (lower > first && lower < last) roots[count++] = lower;
        if (upper > first && upper < last) roots[count++] = upper;
    }
#define POLYNOMIAL_DERIVATIVE(degree) polynomialDerivativeRoots(f, degree, first, last, tolerance, c, roots, count, steps);
    POLYNOMIAL_EACH_DERIVATIVE(POLYNOMIAL_DERIVATIVE)
    return count;
}

#endif
