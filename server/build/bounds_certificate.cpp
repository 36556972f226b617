#include "build/bounds_certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace radiata {
namespace {

/// The next float above, or the largest there is.
float roundUp(double value) {
    constexpr float kMax = std::numeric_limits<float>::max();
    return value >= kMax ? kMax : std::nextafter(static_cast<float>(value), kMax);
}

}  // namespace

GlyphBounds certifyBounds(ShLayout layout, double covering_radius, const BoundsSamples& samples, bool negative_lobes) {
    // Bounds (1) and (2) of the header.
    const auto global = [covering_radius](double sample, int degree) { return sample / std::cos(degree * covering_radius); };
    const auto local = [covering_radius](double sample, double all, int degree) {
        return std::min(all, sample + degree * degree * all * covering_radius * covering_radius / 2);
    };
    const shader::GlyphExtremes& extremes = samples.extremes;
    // A sum of `count` products in float errs by at most count eps sum |c y|; sum c^2 = norm^2 and sum y^2 = count / 4 pi.
    const double count = static_cast<double>(layout.count());
    const double slack = (count + 8) * 0x1p-24 * samples.norm * std::sqrt(count / (4 * std::numbers::pi));
    const double f_max = extremes.f_max;
    const double f_abs = std::max<double>(f_max, extremes.f_low);
    GlyphBounds bounds;
    bounds.amplitude_max = static_cast<float>(std::min<double>(f_abs * samples.scale, std::numeric_limits<float>::max()));
    double radius = global(f_abs + slack, layout.lmax);
    if (!negative_lobes) radius = local(f_max + slack, radius, layout.lmax);
    if (samples.norm == 0 || radius <= 0) return bounds;
    for (int axis = 0; axis < 3; ++axis) {
        const double up = extremes.positive_up[axis], down = extremes.positive_down[axis];
        const double negative_up = extremes.negative_up[axis], negative_down = extremes.negative_down[axis];
        const double all = global(std::max({up, down, negative_up, negative_down}) + slack, layout.lmax + 1);
        double above = negative_lobes ? std::max(up, negative_up) : up;
        double below = negative_lobes ? std::max(down, negative_down) : down;
        if (!layout.full) above = below = std::max(above, below);
        bounds.max[axis] = roundUp(samples.scale * std::min(radius, local(above + slack, all, layout.lmax + 1)));
        bounds.min[axis] = -roundUp(samples.scale * std::min(radius, local(below + slack, all, layout.lmax + 1)));
    }
    bounds.radius = roundUp(samples.scale * radius);
    return bounds;
}

}  // namespace radiata
