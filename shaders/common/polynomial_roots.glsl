// Real roots of a polynomial in an interval by bracketed Newton bisection: between two roots of its derivative a polynomial is
// monotonic, so the roots of all derivatives are found in turn, from the quadratic one upwards.
// Source: Yuksel 2022, High-performance polynomial root finding for graphics, as used by Peters et al. 2023, Sec. 3.5.
// Needs POLYNOMIAL_REAL (float, or double with POLYNOMIAL_DOUBLE), POLYNOMIAL_DEGREE and POLYNOMIAL_EACH_DERIVATIVE (generate/polynomial.py), and the specialisation constants
//   const bool kPolynomialStopOnBracket;  how an iteration ends:
//     false: when two iterates are closer than kPolynomialTolerance times the search interval's half (the paper's rule, with 2e-4)
//     true:  when the bracket is narrower than kPolynomialTolerance max(1, |u|); steps that do not halve their predecessor give way to
//            bisection
//   const float kPolynomialTolerance;
// The loop over derivatives is written out, so that coefficients are registers (3 times faster on a CPU driver, which does not unroll
// it by itself); the loops over intervals are not (as fast, and compiles 20 times faster).
#ifndef RADIATA_COMMON_POLYNOMIAL_ROOTS
#define RADIATA_COMMON_POLYNOMIAL_ROOTS
#extension GL_EXT_control_flow_attributes : require

const int kPolynomialIterationLimit = 90;

POLYNOMIAL_REAL polynomialValue(const POLYNOMIAL_REAL c[POLYNOMIAL_DEGREE + 1], int degree, POLYNOMIAL_REAL u) {
    POLYNOMIAL_REAL value = c[degree];
    [[unroll]] for (int i = degree - 1; i >= 0; --i) value = value * u + c[i];
    return value;
}

// The root in [low, high], where the polynomial changes its sign once. Overflow is harmless: it leaves the sign right, and a step
// that is not a number is replaced by bisection.
POLYNOMIAL_REAL polynomialBracketedRoot(const POLYNOMIAL_REAL c[POLYNOMIAL_DEGREE + 1], int degree, POLYNOMIAL_REAL low, POLYNOMIAL_REAL high, bool low_positive,
                              POLYNOMIAL_REAL tolerance, inout uint steps) {
    POLYNOMIAL_REAL u = 0.5 * (low + high);
    POLYNOMIAL_REAL last_step = high - low;
    for (int iteration = 0; iteration < kPolynomialIterationLimit; ++iteration) {
        POLYNOMIAL_REAL value = c[degree], slope = 0.0;
        [[unroll]] for (int i = degree - 1; i >= 0; --i) {
            slope = slope * u + value;
            value = value * u + c[i];
        }
        ++steps;
        const bool root_above = (value > 0.0) == low_positive;
        low = root_above ? u : low;
        high = root_above ? high : u;
        POLYNOMIAL_REAL next = u - value / slope;
        bool done;
        if (kPolynomialStopOnBracket) {
            const POLYNOMIAL_REAL width = kPolynomialTolerance * max(1.0, abs(u));
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
void polynomialDerivativeRoots(const POLYNOMIAL_REAL f[POLYNOMIAL_DEGREE + 1], int degree, POLYNOMIAL_REAL first, POLYNOMIAL_REAL last, POLYNOMIAL_REAL tolerance,
                               inout POLYNOMIAL_REAL c[POLYNOMIAL_DEGREE + 1], inout POLYNOMIAL_REAL roots[POLYNOMIAL_DEGREE], inout int count,
                               inout uint steps) {
    const POLYNOMIAL_REAL order = POLYNOMIAL_REAL(POLYNOMIAL_DEGREE + 1 - degree);
    [[unroll]] for (int i = degree; i > 0; --i) c[i] = c[i - 1] * (order / POLYNOMIAL_REAL(i));
    c[0] = f[POLYNOMIAL_DEGREE - degree];
    int found = 0;
    POLYNOMIAL_REAL low = first;
    bool low_positive = polynomialValue(c, degree, first) > 0.0;
    for (int i = 0; i <= count; ++i) {
        const POLYNOMIAL_REAL high = i < count ? roots[i] : last;
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
int polynomialExtrema(const POLYNOMIAL_REAL f[POLYNOMIAL_DEGREE + 1], POLYNOMIAL_REAL first, POLYNOMIAL_REAL last, POLYNOMIAL_REAL tolerance,
                      out POLYNOMIAL_REAL roots[POLYNOMIAL_DEGREE], inout uint steps) {
    POLYNOMIAL_REAL c[POLYNOMIAL_DEGREE + 1];
    c[0] = f[POLYNOMIAL_DEGREE - 2];
    c[1] = POLYNOMIAL_REAL(POLYNOMIAL_DEGREE - 1) * f[POLYNOMIAL_DEGREE - 1];
    c[2] = 0.5 * POLYNOMIAL_REAL(POLYNOMIAL_DEGREE * (POLYNOMIAL_DEGREE - 1)) * f[POLYNOMIAL_DEGREE];
    int count = 0;
    const POLYNOMIAL_REAL discriminant = c[1] * c[1] - 4.0 * c[0] * c[2];
    if (discriminant >= 0.0) {
        const POLYNOMIAL_REAL q = -0.5 * (c[1] + (c[1] < 0.0 ? -sqrt(discriminant) : sqrt(discriminant)));
        const POLYNOMIAL_REAL one = q / c[2], other = c[0] / q;
        const POLYNOMIAL_REAL lower = min(one, other), upper = max(one, other);
        if (lower > first && lower < last) roots[count++] = lower;
        if (upper > first && upper < last) roots[count++] = upper;
    }
#define POLYNOMIAL_DERIVATIVE(degree) polynomialDerivativeRoots(f, degree, first, last, tolerance, c, roots, count, steps);
    POLYNOMIAL_EACH_DERIVATIVE(POLYNOMIAL_DERIVATIVE)
    return count;
}

#endif
