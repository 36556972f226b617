// Randomised low-discrepancy points for illumination: pairs of the Sobol sequence with Owen's scrambling, done by hashes, so
// that a point needs nothing but its index and a seed. The same bits as shaders/common/low_discrepancy.glsl. Sources: Kollig &
// Keller 2002 (second dimension without tables); Burley 2020, "Practical hash-based Owen scrambling" (nested uniform scrambling
// by a hash of reversed bits, shuffled indices); Laine & Karras 2011 (the idea of that hash).
#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

namespace radiata {

/// A well mixed word; the finaliser of MurmurHash3 (A. Appleby, public domain).
std::uint32_t mixBits(std::uint32_t word);
/// A seed for what `value` names within what `seed` names (a texel, a replicate, a bounce).
std::uint32_t childSeed(std::uint32_t seed, std::uint32_t value);

/// Point `index` of the sequence `seed`, in [0, 1)^2 with steps of 2^-24. Of each block of 2^m points from a multiple of 2^m
/// on, every one of the m + 1 ways to cut the square into 2^m boxes of equal shape has one point in each box. Sequences of
/// different seeds are independent: their points pair up without pattern, and the spread of their means gives a standard error.
glm::vec2 scrambledSobolPair(std::uint32_t index, std::uint32_t seed);

/// Mean of independent replicates and its standard error.
struct ReplicatedMean {
    double mean = 0;
    double standard_error = 0;  ///< root of the replicates' variance over their number; 0 for fewer than 2
};
ReplicatedMean replicatedMean(std::span<const double> replicates);

/// Texels are sampled in stages that double, and a stop is decided between stages only: 4, 8, 16, ... samples.
constexpr int kFirstStageSamples = 4;
/// Replicates per texel; a stage's samples are divided among them.
constexpr int kReplicates = 4;
/// No texel stops before this many samples: the spread of four short replicates says too little.
constexpr int kLeastSamples = 32;

}  // namespace radiata
