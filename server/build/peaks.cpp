#include "build/peaks.h"

#include <algorithm>
#include <cmath>

#include "build/sphere_grid.h"

namespace radiata {
namespace {

constexpr int kSteps = 200;
constexpr double kSame = 1e-4;      // radians; converged ascents to one peak end much closer together
constexpr double kFlat = 1e-6;      // of the curvature bound
constexpr double kSettled = 1e-10;  // radians, length of the last step

struct Step {
    double along[2] = {0, 0};
    double length() const { return std::hypot(along[0], along[1]); }
};

double largestCurvature(const SphereDerivatives& d) {
    const double mean = 0.5 * (d.curvature[0][0] + d.curvature[1][1]);
    return mean + std::hypot(0.5 * (d.curvature[0][0] - d.curvature[1][1]), d.curvature[0][1]);
}

/// Newton's step where the function is concave, else uphill. \param longest  radians
Step stepFrom(const SphereDerivatives& d, double longest, double flat) {
    Step step;
    if (largestCurvature(d) < -flat) {
        const double determinant = d.curvature[0][0] * d.curvature[1][1] - d.curvature[0][1] * d.curvature[0][1];
        step.along[0] = (-d.curvature[1][1] * d.slope[0] + d.curvature[0][1] * d.slope[1]) / determinant;
        step.along[1] = (-d.curvature[0][0] * d.slope[1] + d.curvature[0][1] * d.slope[0]) / determinant;
    } else {
        const double slope = std::hypot(d.slope[0], d.slope[1]);
        if (slope == 0) return step;
        for (int i = 0; i < 2; ++i) step.along[i] = longest * d.slope[i] / slope;
    }
    const double length = step.length();
    if (length > longest) {
        for (double& along : step.along) along *= longest / length;
    }
    return step;
}

}  // namespace

PeakFinder::PeakFinder(ShLayout layout, std::span<const float> coefficients)
    : layout_(layout), function_(layout, std::vector<double>(coefficients.begin(), coefficients.end())) {}

bool PeakFinder::same(const glm::dvec3& a, const glm::dvec3& b) const {
    const glm::dvec3 end = !layout_.full && glm::dot(a, b) < 0 ? -b : b;
    return glm::length(a - end) < kSame;
}

/// Follows f upwards from p to a strict maximum. Steps stay below a quarter of the finest wave, so that lobes are not jumped.
std::optional<model::Peak> PeakFinder::climb(glm::dvec3 p) const {
    const double flat = kFlat * function_.curvatureBound();
    const double longest = 0.25 / std::max(layout_.lmax, 1);
    SphereDerivatives here = function_(p);
    for (int i = 0; i < kSteps; ++i) {
        Step step = stepFrom(here, longest, flat);
        while (step.length() > kSettled) {
            const glm::dvec3 q = glm::normalize(p + step.along[0] * here.tangent[0] + step.along[1] * here.tangent[1]);
            const SphereDerivatives there = function_(q);
            if (there.value > here.value) {
                p = q;
                here = there;
                break;
            }
            for (double& along : step.along) along *= 0.5;
        }
        if (step.length() <= kSettled) break;
    }
    if (!(here.value > 0) || largestCurvature(here) >= -flat) return std::nullopt;
    return model::Peak{p, here.value};
}

std::vector<model::Peak> PeakFinder::peaks() const {
    std::vector<model::Peak> found;
    if (!(function_.curvatureBound() > 0)) return found;
    for (const glm::dvec3& start : sphereGrid(kStartSpacing / std::max(layout_.lmax, 1), !layout_.full).directions) {
        const std::optional<model::Peak> peak = climb(start);
        if (!peak) continue;
        const auto known =
            std::ranges::find_if(found, [&](const model::Peak& other) { return same(other.direction, peak->direction); });
        if (known == found.end()) found.push_back(*peak);
    }
    std::ranges::stable_sort(found, std::ranges::greater{}, &model::Peak::amplitude);
    return found;
}

std::optional<std::size_t> PeakFinder::lobe(const std::vector<model::Peak>& peaks, const glm::dvec3& direction) const {
    if (!(function_(direction).value > 0)) return std::nullopt;
    const std::optional<model::Peak> top = climb(direction);
    if (!top) return std::nullopt;
    for (std::size_t i = 0; i < peaks.size(); ++i) {
        if (same(peaks[i].direction, top->direction)) return i;
    }
    return std::nullopt;
}

void findPeaks(model::PickedGlyph& glyph) {
    const PeakFinder finder(glyph.layout, glyph.coefficients);
    glyph.peaks = finder.peaks();
    const std::optional<std::size_t> lobe = finder.lobe(glyph.peaks, glyph.direction);
    for (model::Peak& peak : glyph.peaks) {
        if (!glyph.layout.full && glm::dot(peak.direction, glyph.direction) < 0) peak.direction = -peak.direction;
    }
    glyph.peak_angle_deg = 0;
    glyph.peak_rank = lobe ? static_cast<int>(*lobe) + 1 : 0;
    if (lobe) {
        const glm::dvec3& peak = glyph.peaks[*lobe].direction;
        glyph.peak_angle_deg =
            glm::degrees(std::atan2(glm::length(glm::cross(glyph.direction, peak)), glm::dot(glyph.direction, peak)));
    }
}

}  // namespace radiata
