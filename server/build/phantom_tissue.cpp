#include "build/phantom_tissue.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "build/phantom_random.h"

namespace radiata::phantom {
namespace {

struct Ellipsoid {
    glm::dvec3 centre_mm;
    glm::dvec3 radii_mm;

    /// 0 in the centre, 1 on the surface.
    double level(const glm::dvec3& p) const { return glm::length((p - centre_mm) / radii_mm); }
    glm::dvec3 outward(const glm::dvec3& p) const {
        const glm::dvec3 gradient = (p - centre_mm) / (radii_mm * radii_mm);
        return glm::length(gradient) > 0 ? glm::normalize(gradient) : glm::dvec3(0, 0, 1);
    }
};

constexpr double kCortexMm = 5;
const Ellipsoid kCerebrum{{0, -17, 16}, {66, 86, 60}};
const Ellipsoid kCerebellum{{0, -62, -40}, {46, 32, 24}};
const Ellipsoid kBrainstem{{0, -28, -44}, {15, 15, 30}};
const Ellipsoid kVentricle{{13, -14, 13}, {5, 26, 6}};  // right one; mirrored on the left

/// Depth of the folds, in units of the level: two families of waves over the surface.
double folds(const glm::dvec3& p, std::uint64_t seed) {
    const std::uint64_t side = p.x < 0 ? 100 : 200;
    const auto phase = [&](std::uint64_t i) { return 2 * std::numbers::pi * uniform(seed, side + i); };
    const glm::dvec3 q = p / 17.0 * (2 * std::numbers::pi / 2);
    const double waves = std::sin(q.y + 0.4 * q.z + phase(0)) * std::sin(q.z - 0.3 * std::abs(q.x) + phase(1)) +
                         0.6 * std::sin(1.3 * std::abs(q.x) + 0.5 * q.y + phase(2)) * std::sin(0.9 * q.y - q.z + phase(3));
    return 0.045 * std::max(0.0, waves);
}

TissueSample inPart(const Ellipsoid& part, const glm::dvec3& p, double level) {
    const double cortex_level = kCortexMm / std::min({part.radii_mm.x, part.radii_mm.y, part.radii_mm.z});
    const double t = std::clamp((level - (1 - 1.5 * cortex_level)) / (0.5 * cortex_level), 0.0, 1.0);
    return {t > 0.5 ? Tissue::kGrey : Tissue::kWhite, t * t * (3 - 2 * t), part.outward(p)};
}

}  // namespace

TissueSample tissueAt(const glm::dvec3& p_world, std::uint64_t seed) {
    const glm::dvec3 mirrored(std::abs(p_world.x), p_world.y, p_world.z);
    if (kVentricle.level(mirrored) < 1) return {Tissue::kFluid, 0, glm::dvec3(0)};
    const bool below = p_world.z < -28 + 0.12 * std::abs(p_world.y + 17);  // under the temporal lobes and the frontal base
    const bool fissure = mirrored.x < 1.5 && kCerebrum.level(p_world) > 0.55 && (p_world.z > 30 || p_world.y > 40);
    const double level = kCerebrum.level(p_world) + folds(p_world, seed);
    if (level < 1 && !below && !fissure) return inPart(kCerebrum, p_world, level);
    const double stem = kBrainstem.level(p_world);
    if (stem < 1) return {Tissue::kWhite, 0, kBrainstem.outward(p_world)};
    const double cerebellar = kCerebellum.level(p_world) + 0.03 * std::max(0.0, std::sin(1.1 * p_world.z));
    if (cerebellar < 1) return inPart(kCerebellum, p_world, cerebellar);
    return {};
}

}  // namespace radiata::phantom
