// Pairs of the Sobol sequence with Owen's scrambling by hashes: the same bits as server/math/low_discrepancy.cpp, which names the
// sources and what they promise.
#ifndef RADIATA_COMMON_LOW_DISCREPANCY
#define RADIATA_COMMON_LOW_DISCREPANCY

uint mixBits(uint word) {
    word ^= word >> 16u;
    word *= 0x85ebca6bu;
    word ^= word >> 13u;
    word *= 0xc2b2ae35u;
    return word ^ (word >> 16u);
}

uint childSeed(uint seed, uint value) { return mixBits(seed ^ mixBits(value + 0x9e3779b9u)); }

uint owenScramble(uint word, uint seed) {
    word = bitfieldReverse(word);
    word ^= word * 0x3d20adeau;
    word += seed;
    word *= (seed >> 16u) | 1u;
    word ^= word * 0x05526c56u;
    word ^= word * 0x53a22864u;
    return bitfieldReverse(word);
}

uint sobolSecond(uint index) {
    uint result = 0u;
    for (uint direction = 1u << 31u; index != 0u; index >>= 1u, direction ^= direction >> 1u) {
        if ((index & 1u) != 0u) result ^= direction;
    }
    return result;
}

vec2 scrambledSobolPair(uint index, uint seed) {
    const uint place = owenScramble(index, childSeed(seed, 0u));
    const uvec2 words = uvec2(owenScramble(bitfieldReverse(place), childSeed(seed, 1u)),
                              owenScramble(sobolSecond(place), childSeed(seed, 2u)));
    return vec2(words >> 8u) * 5.9604644775390625e-8;
}

#endif
