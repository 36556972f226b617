#include "math/low_discrepancy.h"

#include <cmath>

namespace radiata {
namespace {

std::uint32_t reverseBits(std::uint32_t word) {
    word = ((word >> 1) & 0x55555555U) | ((word & 0x55555555U) << 1);
    word = ((word >> 2) & 0x33333333U) | ((word & 0x33333333U) << 2);
    word = ((word >> 4) & 0x0f0f0f0fU) | ((word & 0x0f0f0f0fU) << 4);
    word = ((word >> 8) & 0x00ff00ffU) | ((word & 0x00ff00ffU) << 8);
    return (word >> 16) | (word << 16);
}

/// Every bit is flipped or not by a hash of the bits below it and the seed: products with even numbers carry upwards only.
std::uint32_t scrambleFromLow(std::uint32_t word, std::uint32_t seed) {
    word ^= word * 0x3d20adeaU;
    word += seed;
    word *= (seed >> 16) | 1U;
    word ^= word * 0x05526c56U;
    word ^= word * 0x53a22864U;
    return word;
}

std::uint32_t owenScramble(std::uint32_t word, std::uint32_t seed) {
    return reverseBits(scrambleFromLow(reverseBits(word), seed));
}

/// The second Sobol dimension: rows of Pascal's triangle modulo 2.
std::uint32_t sobolSecond(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t direction = 1U << 31; index != 0; index >>= 1, direction ^= direction >> 1) {
        if ((index & 1U) != 0) result ^= direction;
    }
    return result;
}

float unitFloat(std::uint32_t word) { return static_cast<float>(word >> 8) * 0x1p-24F; }

}  // namespace

std::uint32_t mixBits(std::uint32_t word) {
    word ^= word >> 16;
    word *= 0x85ebca6bU;
    word ^= word >> 13;
    word *= 0xc2b2ae35U;
    return word ^ (word >> 16);
}

std::uint32_t childSeed(std::uint32_t seed, std::uint32_t value) { return mixBits(seed ^ mixBits(value + 0x9e3779b9U)); }

glm::vec2 scrambledSobolPair(std::uint32_t index, std::uint32_t seed) {
    // The order of points is scrambled as well, so that pairs of different seeds do not run in step.
    const std::uint32_t place = owenScramble(index, childSeed(seed, 0));
    return {unitFloat(owenScramble(reverseBits(place), childSeed(seed, 1))),
            unitFloat(owenScramble(sobolSecond(place), childSeed(seed, 2)))};
}

ReplicatedMean replicatedMean(std::span<const double> replicates) {
    ReplicatedMean result;
    const auto count = static_cast<double>(replicates.size());
    if (replicates.empty()) return result;
    for (const double value : replicates) result.mean += value / count;
    if (replicates.size() < 2) return result;
    double squares = 0;
    for (const double value : replicates) squares += (value - result.mean) * (value - result.mean);
    result.standard_error = std::sqrt(squares / (count * (count - 1)));
    return result;
}

}  // namespace radiata
