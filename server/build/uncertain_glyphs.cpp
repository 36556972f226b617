#include "build/uncertain_glyphs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "base/error.h"
#include "base/parallel.h"
#include "build/phantom_random.h"
#include "math/gauss_legendre.h"
#include "math/sh_evaluate.h"

namespace radiata {
namespace {

[[noreturn]] void refuse(const std::string& sentence) { throw Error(Code::kInvalidArgument, sentence); }

std::string text(const glm::ivec3& v) {
    return std::to_string(v.x) + " x " + std::to_string(v.y) + " x " + std::to_string(v.z);
}

std::string text(ShLayout layout) {
    return std::string(layout.full ? "all" : "even") + " bands to " + std::to_string(layout.lmax);
}

/// Order in which images store voxels.
auto storageOrder(const glm::ivec3& v) { return std::make_tuple(v.z, v.y, v.x); }

/// Directions and weights that integrate products of two functions of the layout exactly, with nodes to spare for functions
/// that are not of it; half of the sphere for even layouts, as deviations are then even too.
struct SphereRule {
    std::vector<double> weights;
    std::vector<double> basis;  ///< weights.size() x layout.count()

    explicit SphereRule(ShLayout layout) {
        const int nodes = 2 * layout.lmax + 4;
        const int azimuths = 2 * nodes;
        std::vector<double> values(layout.count());
        for (const auto& [z, weight] : gaussLegendre(nodes)) {
            if (!layout.full && z < 0) continue;
            const double radius = std::sqrt((1 - z) * (1 + z));
            for (int i = 0; i < azimuths; ++i) {
                const double phi = 2 * std::numbers::pi * i / azimuths;
                evaluateSh(layout, glm::dvec3(radius * std::cos(phi), radius * std::sin(phi), z), values);
                weights.push_back((layout.full ? 1 : 2) * weight * 2 * std::numbers::pi / azimuths);
                basis.insert(basis.end(), values.begin(), values.end());
            }
        }
    }
};

void checkDeviations(const model::ShImage& mean, const model::ShImage& deviations) {
    checkSameGrid(mean, deviations);
    if (!(mean.layout == deviations.layout)) {
        refuse("uncertainty: '" + deviations.source + "' has " + text(deviations.layout) + ", '" + mean.source + "' has " +
               text(mean.layout) + "; standard deviations need one volume for each coefficient");
    }
    if (deviations.file_axes != ShAxes::kWorld) {
        refuse("uncertainty: standard deviations in voxel axes cannot be turned to world axes without their correlations; '" +
               deviations.source + "' must be written in world axes");
    }
    if (deviations.rejected_voxels > 0) {
        refuse("uncertainty: '" + deviations.source + "' has " + std::to_string(deviations.rejected_voxels) +
               " voxels with a standard deviation that is NaN or infinite; all must be finite and at least 0");
    }
    const std::size_t count = deviations.layout.count();
    // Conventions order coefficients differently and flip signs; what the file holds must not be negative.
    parallelFor(deviations.voxels.size(), 4096, [&](std::size_t begin, std::size_t end) {
        std::vector<float> filed(count);
        for (std::size_t v = begin; v < end; ++v) {
            std::copy_n(deviations.coefficients.begin() + static_cast<std::ptrdiff_t>(v * count), count, filed.begin());
            convertSh(filed, deviations.layout, ShConvention::kDescoteaux07, deviations.file_convention);
            const auto lowest = std::ranges::min_element(filed);
            if (*lowest < 0) {
                refuse("uncertainty: '" + deviations.source + "' has a standard deviation of " + std::to_string(*lowest) +
                       " in voxel (" + std::to_string(deviations.voxels[v].x) + ", " + std::to_string(deviations.voxels[v].y) +
                       ", " + std::to_string(deviations.voxels[v].z) + "), volume " + std::to_string(lowest - filed.begin()) +
                       "; none may be negative");
            }
        }
    });
}

}  // namespace

void checkSameGrid(const model::ShImage& image, const model::ShImage& uncertainty) {
    if (image.size != uncertainty.size) {
        refuse("uncertainty: '" + uncertainty.source + "' has " + text(uncertainty.size) + " voxels, '" + image.source +
               "' has " + text(image.size) + "; both must be on the same grid");
    }
    // The farthest any voxel's corner is apart, in voxels of the first image.
    const glm::dmat4 difference = glm::inverse(image.voxel_to_world) * uncertainty.voxel_to_world - glm::dmat4(1.0);
    double apart = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 at((corner & 1) ? image.size.x : 0, (corner & 2) ? image.size.y : 0, (corner & 4) ? image.size.z : 0,
                            1);
        const double length = glm::length(glm::dvec3(difference * at));
        if (!(length <= apart)) apart = length;  // NaN stays, and is refused
    }
    if (!(apart <= 1e-3)) {
        refuse("uncertainty: the voxels of '" + uncertainty.source + "' lie up to " + std::to_string(apart) +
               " voxels apart from those of '" + image.source + "'; both must be on the same grid");
    }
}

std::vector<std::uint32_t> matchVoxels(const model::ShImage& image, std::span<const std::uint32_t> slots,
                                       const model::ShImage& other) {
    std::vector<std::uint32_t> matches(slots.size(), kNoVoxel);
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const glm::ivec3& voxel = image.voxels[slots[i]];
        const auto found = std::ranges::lower_bound(other.voxels, storageOrder(voxel), {}, storageOrder);
        if (found != other.voxels.end() && *found == voxel) {
            matches[i] = static_cast<std::uint32_t>(found - other.voxels.begin());
        }
    }
    return matches;
}

model::ShImage uncertaintyByRecipe(const model::ShImage& mean, const UncertaintyRecipe& recipe,
                                   const std::function<void(std::size_t)>& progress) {
    if (!(recipe.constant >= 0 && recipe.constant <= 100)) {
        refuse("the factor of the constant part is " + std::to_string(recipe.constant) + "; it must be 0 to 100");
    }
    if (!(recipe.deviation >= 0 && recipe.deviation <= 100)) {
        refuse("the deviation is " + std::to_string(recipe.deviation) + "; it must be 0 to 100");
    }
    model::ShImage image = mean;
    const std::size_t count = image.layout.count();
    parallelFor(image.voxels.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            const glm::ivec3& p = image.voxels[v];
            const std::uint64_t voxel =
                (static_cast<std::uint64_t>(p.z) * static_cast<std::uint64_t>(image.size.y) + static_cast<std::uint64_t>(p.y)) *
                    static_cast<std::uint64_t>(image.size.x) +
                static_cast<std::uint64_t>(p.x);
            for (std::size_t c = 0; c < count; ++c) {
                float& value = image.coefficients[v * count + c];
                const double variate = 1 + recipe.deviation * phantom::gaussian(recipe.seed, voxel * count + c);
                value = static_cast<float>(value * (c == 0 ? recipe.constant : 1) * variate);
            }
        }
        if (progress) progress(end - begin);
    });
    return image;
}

model::ShImage outerGlyphs(const model::ShImage& mean, std::span<const std::uint32_t> slots, const model::ShImage& deviations,
                           double factor, int lmax) {
    checkDeviations(mean, deviations);
    model::ShImage outer = mean;
    outer.layout.lmax = std::min(lmax, mean.layout.lmax);
    if (!outer.layout.full) outer.layout.lmax -= outer.layout.lmax % 2;
    outer.voxels.clear();
    for (const std::uint32_t slot : slots) outer.voxels.push_back(mean.voxels[slot]);
    const std::size_t count = outer.layout.count(), stride = mean.layout.count();
    outer.coefficients.assign(slots.size() * count, 0.0F);
    const std::vector<std::uint32_t> matches = matchVoxels(mean, slots, deviations);
    const SphereRule rule(outer.layout);
    parallelFor(slots.size(), 64, [&](std::size_t begin, std::size_t end) {
        std::vector<double> fit(count);
        for (std::size_t v = begin; v < end; ++v) {
            std::ranges::fill(fit, 0.0);
            if (matches[v] != kNoVoxel) {
                const float* deviation = deviations.coefficients.data() + matches[v] * stride;
                for (std::size_t q = 0; q < rule.weights.size(); ++q) {
                    const double* basis = rule.basis.data() + q * count;
                    double variance = 0;
                    for (std::size_t c = 0; c < count; ++c) {
                        const double part = basis[c] * static_cast<double>(deviation[c]);
                        variance += part * part;
                    }
                    const double weighted = rule.weights[q] * std::sqrt(variance);
                    for (std::size_t c = 0; c < count; ++c) fit[c] += weighted * basis[c];
                }
            }
            for (std::size_t c = 0; c < count; ++c) {
                const double value = mean.coefficients[slots[v] * stride + c];
                outer.coefficients[v * count + c] = static_cast<float>(value + factor * fit[c]);
            }
        }
    });
    return outer;
}

}  // namespace radiata
