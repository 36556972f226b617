// Random numbers that depend on nothing but a seed and a place in the data, so that results are the same on any number of
// threads. Source: the mixing function of SplitMix64 (Steele, Lea and Flood 2014), used as a hash of a counter.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace radiata::phantom {

inline std::uint64_t hash(std::uint64_t seed, std::uint64_t counter) {
    std::uint64_t z = seed * 0xD1342543DE82EF95U + (counter + 1) * 0x9E3779B97F4A7C15U;
    for (int round = 0; round < 2; ++round) {
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
        z ^= z >> 31;
    }
    return z;
}

/// Evenly distributed in (0, 1].
inline double uniform(std::uint64_t seed, std::uint64_t counter) {
    return static_cast<double>((hash(seed, counter) >> 11) + 1) * 0x1p-53;
}

/// Normally distributed with mean 0 and standard deviation 1.
inline double gaussian(std::uint64_t seed, std::uint64_t counter) {
    const double radius = std::sqrt(-2 * std::log(uniform(seed, 2 * counter)));
    return radius * std::cos(2 * std::numbers::pi * uniform(seed, 2 * counter + 1));
}

}  // namespace radiata::phantom
