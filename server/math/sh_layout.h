// How spherical-harmonics coefficients are counted and ordered.
// Even basis: bands 0, 2, 4, ... ; coefficient (l, m) stands at l (l + 1) / 2 + m.
// Full basis: bands 0, 1, 2, ... ; coefficient (l, m) stands at l (l + 1) + m.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace radiata {

constexpr int kLmaxLimit = 16;

/// Which bands are there, and the highest one.
struct ShLayout {
    int lmax = 0;
    bool full = false;  ///< odd bands too

    int step() const { return full ? 1 : 2; }
    std::size_t count() const { return static_cast<std::size_t>(full ? (lmax + 1) * (lmax + 1) : (lmax + 1) * (lmax + 2) / 2); }
    std::size_t index(int l, int m) const { return static_cast<std::size_t>(full ? l * (l + 1) + m : l * (l + 1) / 2 + m); }
    bool operator==(const ShLayout&) const = default;
};

/// Entries of the pole-frame table of a glyph with bands up to an even k; shaders/generate/pole_table.py, entries().
/// Even layouts: h = 0, 2, ... k; full ones: h = 0, 1, ... k; cosines and sines of each order m, odd orders without h = 0.
constexpr std::uint64_t poleTableCount(int k, bool full) {
    const int waves = full ? k + 1 : k / 2 + 1;
    const int even_orders = k / 2, odd_orders = k / 2;
    return static_cast<std::uint64_t>(waves + 2 * even_orders * waves + 2 * odd_orders * (waves - 1));
}

/// The layout with this many coefficients: even 1, 6, 15, 28, 45, 66, 91, 120, 153; full 1, 4, 9, 16, ... 289.
/// A count that both have (1) is even unless `full` asks otherwise. Nothing if no layout up to band 16 has that count.
std::optional<ShLayout> shLayoutOfCount(std::size_t count, std::optional<bool> full = std::nullopt);

}  // namespace radiata
