// How spherical-harmonics coefficients are counted and ordered.
// Even basis: bands 0, 2, 4, ... ; coefficient (l, m) stands at l (l + 1) / 2 + m.
// Full basis: bands 0, 1, 2, ... ; coefficient (l, m) stands at l (l + 1) + m.
#pragma once

#include <cstddef>
#include <optional>

namespace radiata {

constexpr int kLmaxLimit = 16;

/// Which bands are there, and the highest one.
struct ShLayout {
    int lmax = 0;
    bool full = false;  ///< odd bands too

    int step() const { return full ? 1 : 2; }
    std::size_t count() const {
        return static_cast<std::size_t>(full ? (lmax + 1) * (lmax + 1) : (lmax + 1) * (lmax + 2) / 2);
    }
    std::size_t index(int l, int m) const { return static_cast<std::size_t>(full ? l * (l + 1) + m : l * (l + 1) / 2 + m); }
    bool operator==(const ShLayout&) const = default;
};

/// The layout with this many coefficients: even 1, 6, 15, 28, 45, 66, 91, 120, 153; full 1, 4, 9, 16, ... 289.
/// A count that both have (1) is even unless `full` asks otherwise. Nothing if no layout up to band 16 has that count.
std::optional<ShLayout> shLayoutOfCount(std::size_t count, std::optional<bool> full = std::nullopt);

}  // namespace radiata
