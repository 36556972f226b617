#include "reference/glyph_hits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radiata::reference {
namespace {

constexpr double kMoveRadii = 1e-5;
constexpr double kCentreRadii = 1e-13;  // closer than rounding can tell: through the centre
constexpr double kNarrowest = 1e-7;     // radians; two roots closer than this count as touching

struct Line {
    glm::dvec3 direction;
    glm::dvec3 e;       // unit, from the centre to the nearest point of the line
    double along = 0;   // origin . direction
    double height = 0;  // distance of the line from the centre
};

Line lineOf(const glm::dvec3& origin, const glm::dvec3& direction) {
    Line line{direction, {}, glm::dot(origin, direction), 0};
    glm::dvec3 foot = origin - line.along * direction;
    foot -= glm::dot(foot, direction) * direction;
    line.height = glm::length(foot);
    line.e = line.height > 0 ? foot / line.height : anyOrthogonal(direction);
    return line;
}

/// Solves lobe * f(psi) sin psi = h on one half of the line: psi in [0, pi/2] is the angle between the line's end (side *
/// direction) and the direction from the centre to the point.
class HalfLine {
public:
    HalfLine(const ShFunction& f, const Line& line, double side, double lobe, double second_derivative_max)
        : f_(f), line_(line), side_(side), lobe_(lobe), bound_(second_derivative_max) {}

    void findHits(std::vector<GlyphHit>& hits, bool& touching) {
        const int cells = 8 * (f_.layout().lmax + 2);
        const double width = std::numbers::pi / 2 / cells;
        double start_value = excess(0);
        for (int i = 0; i < cells; ++i) {
            const double end = i + 1 == cells ? std::numbers::pi / 2 : (i + 1) * width;
            const double end_value = excess(end);
            search(i * width, start_value, end, end_value, hits, touching);
            start_value = end_value;
        }
    }

private:
    glm::dvec3 towards(double psi) const { return side_ * std::cos(psi) * line_.direction + std::sin(psi) * line_.e; }
    /// Negative outside the glyph, positive inside.
    double excess(double psi) const { return lobe_ * f_(towards(psi)) * std::sin(psi) - line_.height; }

    /// Since |excess''| <= bound_, a chord deviates from the function by at most bound_ width^2 / 8, and a slope of the chord
    /// above bound_ width makes the function monotonic: cells are split until one of the two decides.
    void search(double a, double value_a, double b, double value_b, std::vector<GlyphHit>& hits, bool& touching) {
        const double width = b - a;
        const bool crosses = (value_a > 0) != (value_b > 0);
        if (!crosses && std::min(std::abs(value_a), std::abs(value_b)) > bound_ * width * width / 8) return;
        if (crosses && std::abs(value_b - value_a) > bound_ * width * width) return bisect(a, value_a, b, hits);
        if (width < kNarrowest) {
            touching = true;
            if (crosses) bisect(a, value_a, b, hits);
            return;
        }
        const double middle = a + width / 2;
        const double value = excess(middle);
        search(a, value_a, middle, value, hits, touching);
        search(middle, value, b, value_b, hits, touching);
    }

    void bisect(double a, double value_a, double b, std::vector<GlyphHit>& hits) {
        for (int i = 0; i < 200; ++i) {
            const double middle = a + (b - a) / 2;
            if (middle <= a || middle >= b) break;
            ((excess(middle) > 0) == (value_a > 0) ? a : b) = middle;
        }
        add(b, hits);
    }

    void add(double psi, std::vector<GlyphHit>& hits) {
        // h / tan psi loses digits at small angles, |f| cos psi at large ones.
        const double amplitude = f_(towards(psi));
        const double distance = std::sin(psi) < 0.5 ? std::abs(amplitude) * std::cos(psi) : line_.height / std::tan(psi);
        hits.push_back({side_ * distance - line_.along, amplitude, {}});
    }

    const ShFunction& f_;
    const Line& line_;
    double side_, lobe_, bound_;
};

/// A bound of |f| on the great circle in the line's plane. Between samples that are x apart, a trigonometric polynomial of
/// degree k exceeds its largest sample at most by the factor 1 / cos(k x / 2) (M. Riesz).
double circleMaximum(const ShFunction& f, const Line& line) {
    const int degree = f.layout().lmax;
    const int samples = 16 * (degree + 1);
    double largest = 0;
    for (int i = 0; i < samples; ++i) {
        const double x = 2 * std::numbers::pi * i / samples;
        largest = std::max(largest, std::abs(f(std::cos(x) * line.direction + std::sin(x) * line.e)));
    }
    return largest / std::cos(degree * std::numbers::pi / samples);
}

std::vector<GlyphHit> hitsOnLine(const ShFunction& f, const Line& line, double circle_max, bool both_lobes, bool& touching) {
    std::vector<GlyphHit> hits;
    if (line.height <= kCentreRadii * circle_max) {
        for (const double side : {-1.0, 1.0}) {
            const double amplitude = f(side * line.direction);
            if (amplitude > 0 || (both_lobes && amplitude < 0)) {
                hits.push_back({side * std::abs(amplitude) - line.along, amplitude, {}});
            }
        }
        return hits;
    }
    if (line.height > circle_max) return hits;
    // Bernstein: f(psi) sin psi has degree k + 1 and its second derivative is at most (k + 1)^2 times its maximum.
    const double bound = (f.layout().lmax + 1) * (f.layout().lmax + 1) * circle_max;
    for (const double side : {-1.0, 1.0}) {
        HalfLine(f, line, side, 1, bound).findHits(hits, touching);
        if (both_lobes) HalfLine(f, line, side, -1, bound).findHits(hits, touching);
    }
    std::sort(hits.begin(), hits.end(), [](const GlyphHit& a, const GlyphHit& b) { return a.t < b.t; });
    return hits;
}

void dropBefore(std::vector<GlyphHit>& hits, double t_min) {
    std::erase_if(hits, [t_min](const GlyphHit& hit) { return hit.t < t_min; });
}

bool sameSigns(const std::vector<GlyphHit>& a, const std::vector<GlyphHit>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const GlyphHit& x, const GlyphHit& y) { return (x.amplitude > 0) == (y.amplitude > 0); });
}

double shiftOfFirst(const std::vector<GlyphHit>& a, const std::vector<GlyphHit>& b) {
    if (a.empty() && b.empty()) return 0;
    if (a.empty() || b.empty() || (a[0].amplitude > 0) != (b[0].amplitude > 0)) return std::numeric_limits<double>::infinity();
    return std::abs(a[0].t - b[0].t);
}

}  // namespace

GlyphHits glyphHits(const ShFunction& f, const glm::dvec3& origin, const glm::dvec3& direction, bool both_lobes, double t_min) {
    GlyphHits result;
    Line line = lineOf(origin, direction);
    const double circle_max = circleMaximum(f, line);
    if (!(circle_max > 0)) return result;
    result.hits = hitsOnLine(f, line, circle_max, both_lobes, result.grazing);
    dropBefore(result.hits, t_min);
    for (GlyphHit& hit : result.hits) {
        hit.normal = glyphNormal(f, line.height * line.e + (hit.t + line.along) * direction);
    }
    const double height = line.height;
    for (const double move : {-kMoveRadii, kMoveRadii}) {
        line.height = std::abs(height + move * circle_max);
        bool touching = false;
        std::vector<GlyphHit> moved = hitsOnLine(f, line, circle_max, both_lobes, touching);
        dropBefore(moved, t_min);
        result.grazing = result.grazing || !sameSigns(result.hits, moved);
        result.first_shift = std::max(result.first_shift, shiftOfFirst(result.hits, moved) / circle_max);
    }
    return result;
}

glm::dvec3 glyphNormal(const ShFunction& f, const glm::dvec3& p) {
    const glm::dvec3 direction = glm::normalize(p);
    const double amplitude = f(direction);
    return glm::normalize(std::abs(amplitude) * direction - (amplitude < 0 ? -1.0 : 1.0) * f.gradient(direction));
}

}  // namespace radiata::reference
