// Extents of many glyphs over up to a million directions each: what no bound may fall below.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "math/sh_evaluate.h"

namespace radiata::testing {

/// Largest values over the samples: of |f|, then of d_a |f| along +x, +y, +z, -x, -y, -z; once for both lobes, once for f > 0.
struct SampledExtents {
    std::array<float, 7> both{}, positive{};
};

/// Spherical Fibonacci points. Values in float32: each is off by about 1e-6 of the glyph's size.
/// \param coefficients  glyph by glyph, layout.count() each
inline std::vector<SampledExtents> sampleExtents(ShLayout layout, std::span<const float> coefficients, std::size_t samples) {
    constexpr std::size_t kTile = 32, kBlock = 1024;
    const std::size_t count = layout.count(), glyphs = coefficients.size() / count;
    std::vector<SampledExtents> extents(glyphs);
    std::vector<float> table(kBlock * (count + 3));
    for (std::size_t begin = 0; begin < samples; begin += kBlock) {
        // A tile: 32 directions' x, then y, z and each basis function.
        parallelFor(kBlock / kTile, 2, [&](std::size_t first, std::size_t last) {
            std::vector<double> basis(count);
            for (std::size_t i = first * kTile; i < last * kTile; ++i) {
                const double at = static_cast<double>(std::min(begin + i, samples - 1)), n = static_cast<double>(samples);
                const double z = 1 - (2 * at + 1) / n,
                             turn = 2 * std::numbers::pi * std::fmod(at * (std::numbers::phi - 1), 1.0);
                const glm::dvec3 d(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
                evaluateSh(layout, d, basis);
                float* tile = table.data() + i / kTile * kTile * (count + 3) + i % kTile;
                for (int axis = 0; axis < 3; ++axis) tile[static_cast<std::size_t>(axis) * kTile] = static_cast<float>(d[axis]);
                for (std::size_t j = 0; j < count; ++j) tile[(j + 3) * kTile] = static_cast<float>(basis[j]);
            }
        });
        parallelFor(glyphs, 8, [&](std::size_t first, std::size_t last) {
            for (std::size_t g = first; g < last; ++g) {
                const float* c = coefficients.data() + g * count;
                SampledExtents& e = extents[g];
                for (const float* tile = table.data(); tile < table.data() + table.size(); tile += kTile * (count + 3)) {
                    float f[kTile] = {};
                    for (std::size_t j = 0; j < count; ++j) {
                        const float* basis = tile + (j + 3) * kTile;
                        for (std::size_t i = 0; i < kTile; ++i) f[i] += c[j] * basis[i];
                    }
                    for (std::size_t i = 0; i < kTile; ++i) {
                        const float size = std::abs(f[i]), positive = std::max(f[i], 0.0F);
                        e.both[0] = std::max(e.both[0], size);
                        e.positive[0] = std::max(e.positive[0], positive);
                        for (std::size_t axis = 0; axis < 3; ++axis) {
                            const float d = tile[axis * kTile + i];
                            e.both[1 + axis] = std::max(e.both[1 + axis], d * size);
                            e.both[4 + axis] = std::max(e.both[4 + axis], -d * size);
                            e.positive[1 + axis] = std::max(e.positive[1 + axis], d * positive);
                            e.positive[4 + axis] = std::max(e.positive[4 + axis], -d * positive);
                        }
                    }
                }
            }
        });
    }
    return extents;
}

}  // namespace radiata::testing
