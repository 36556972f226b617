// Samples by tiles of 16 directions times two glyphs, which fill the vector registers; the reasoning stands in the header.
#include "build/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "build/bounds_certificate.h"
#include "build/sphere_grid.h"
#include "math/sh_evaluate.h"

namespace radiata {
namespace {

constexpr double kEnlargement = 1.02;
constexpr std::size_t kTile = 16;
constexpr std::size_t kBlock = 64;  // glyphs that share a tile while it is in the cache

using Lanes = float __attribute__((vector_size(16)));
constexpr std::size_t kLanes = 4;
constexpr std::size_t kVectors = kTile / kLanes;

Lanes maximum(Lanes a, Lanes b) { return a > b ? a : b; }
Lanes minimum(Lanes a, Lanes b) { return a < b ? a : b; }
float maximum(Lanes a) { return std::max({a[0], a[1], a[2], a[3]}); }
Lanes load(const float* values) {
    Lanes lanes;
    __builtin_memcpy(&lanes, values, sizeof lanes);
    return lanes;
}

/// What the samples of one glyph showed, lane by lane. Each starts at 0 but the maximum of f.
struct Extremes {
    Lanes f_max, f_min;
    std::array<Lanes, 3> positive_up, positive_down;  // max of d_a f and of -d_a f where f > 0
    std::array<Lanes, 3> negative_up, negative_down;  // max of d_a |f| and of -d_a |f| where f < 0

    Extremes() {
        const Lanes zero{};
        f_max = zero - std::numeric_limits<float>::max();
        f_min = zero;
        positive_up = positive_down = negative_up = negative_down = {zero, zero, zero};
    }

    void add(Lanes f, const std::array<Lanes, 3>& direction) {
        const Lanes zero{};
        f_max = maximum(f_max, f);
        f_min = minimum(f_min, f);
        const Lanes positive = maximum(f, zero);
        const Lanes negative = zero - minimum(f, zero);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Lanes positive_extent = direction[axis] * positive;
            const Lanes negative_extent = direction[axis] * negative;
            positive_up[axis] = maximum(positive_up[axis], positive_extent);
            positive_down[axis] = maximum(positive_down[axis], zero - positive_extent);
            negative_up[axis] = maximum(negative_up[axis], negative_extent);
            negative_down[axis] = maximum(negative_down[axis], zero - negative_extent);
        }
    }
};

/// Values of two glyphs on the tile's directions.
void sampleTile(const float* tile, const float* first, const float* second, std::size_t count, Extremes& first_extremes,
                Extremes& second_extremes) {
    std::array<Lanes, kVectors> f{}, g{};
    const float* basis = tile + 3 * kTile;
    for (std::size_t j = 0; j < count; ++j, basis += kTile) {
        const Lanes a = Lanes{} + first[j];
        const Lanes b = Lanes{} + second[j];
#pragma GCC unroll 4
        for (std::size_t v = 0; v < kVectors; ++v) {
            const Lanes y = load(basis + v * kLanes);
            f[v] += a * y;
            g[v] += b * y;
        }
    }
    for (std::size_t v = 0; v < kVectors; ++v) {
        const std::array<Lanes, 3> direction{load(tile + v * kLanes), load(tile + kTile + v * kLanes),
                                             load(tile + 2 * kTile + v * kLanes)};
        first_extremes.add(f[v], direction);
        second_extremes.add(g[v], direction);
    }
}

/// The largest over the lanes.
shader::GlyphExtremes gather(const Extremes& lanes) {
    shader::GlyphExtremes extremes{maximum(lanes.f_max), maximum(-lanes.f_min), {}, {}, {}, {}};
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        extremes.positive_up[axis] = maximum(lanes.positive_up[a]);
        extremes.positive_down[axis] = maximum(lanes.positive_down[a]);
        extremes.negative_up[axis] = maximum(lanes.negative_up[a]);
        extremes.negative_down[axis] = maximum(lanes.negative_down[a]);
    }
    return extremes;
}

}  // namespace

BoundsEvaluator::BoundsEvaluator(ShLayout layout) : layout_(layout) {
    SphereGrid grid = sphereGrid(std::acos(1 / kEnlargement) / (layout.lmax + 1), !layout.full);
    directions_ = std::move(grid.directions);
    covering_radius_ = grid.covering_radius;
    const std::size_t count = layout.count();
    const std::size_t tile_count = (directions_.size() + kTile - 1) / kTile;
    tiles_.resize(tile_count * (count + 3) * kTile);
    std::vector<double> basis(count);
    for (std::size_t i = 0; i < tile_count * kTile; ++i) {
        const glm::dvec3& d = directions_[std::min(i, directions_.size() - 1)];
        float* tile = tiles_.data() + i / kTile * (count + 3) * kTile + i % kTile;
        evaluateSh(layout, d, basis);
        for (int axis = 0; axis < 3; ++axis) tile[axis * kTile] = static_cast<float>(d[axis]);
        for (std::size_t j = 0; j < count; ++j) tile[(j + 3) * kTile] = static_cast<float>(basis[j]);
    }
}

void BoundsEvaluator::evaluate(std::span<const float> coefficients, bool negative_lobes, std::span<GlyphBounds> out) const {
    const std::size_t count = layout_.count();
    if (coefficients.size() != out.size() * count) {
        throw Error(Code::kInternal, "glyph bounds: " + std::to_string(coefficients.size()) + " coefficients for " +
                                         std::to_string(out.size()) + " glyphs of " + std::to_string(count));
    }
    parallelFor(out.size(), kBlock, [&](std::size_t begin, std::size_t end) {
        evaluateBlock(coefficients.subspan(begin * count, (end - begin) * count), negative_lobes,
                      out.subspan(begin, end - begin));
    });
}

void BoundsEvaluator::evaluateBlock(std::span<const float> coefficients, bool negative_lobes,
                                    std::span<GlyphBounds> out) const {
    const std::size_t count = layout_.count();
    const std::size_t padded = (out.size() + 1) / 2 * 2;
    std::vector<float> scaled(padded * count, 0.0F);
    std::vector<double> scales(out.size(), 0.0), norms(out.size(), 0.0);
    for (std::size_t g = 0; g < out.size(); ++g) {
        const auto source = coefficients.subspan(g * count, count);
        for (float c : source) {
            if (!std::isfinite(c)) throw Error(Code::kInvalidArgument, "glyph bounds: a coefficient is not finite");
            scales[g] = std::max(scales[g], std::abs(static_cast<double>(c)));
        }
        for (std::size_t j = 0; j < count && scales[g] > 0; ++j) {
            const double value = source[j] / scales[g];  // in double, as 1 / scale of a tiny glyph overflows float
            scaled[g * count + j] = static_cast<float>(value);
            norms[g] += value * value;
        }
    }
    std::vector<Extremes> extremes(padded);
    const std::size_t tile_size = (count + 3) * kTile;
    for (const float* tile = tiles_.data(); tile != tiles_.data() + tiles_.size(); tile += tile_size) {
        for (std::size_t g = 0; g < padded; g += 2) {
            const float* first = scaled.data() + g * count;
            sampleTile(tile, first, first + count, count, extremes[g], extremes[g + 1]);
        }
    }
    for (std::size_t g = 0; g < out.size(); ++g) {
        out[g] =
            certifyBounds(layout_, covering_radius_, {gather(extremes[g]), std::sqrt(norms[g]), scales[g]}, negative_lobes);
    }
}

}  // namespace radiata
