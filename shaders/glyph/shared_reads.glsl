// Reads that a whole subgroup wants alike: each of its first eight invocations reads every eighth word and hands it to the others. A
// read by address costs a CPU driver a branch per invocation, a hand-over nothing of the kind; rays of neighbouring pixels mostly meet the
// same glyph. Included by compute shaders that say GLYPH_SHARED_READS and have the extension of ballots.
const uint kReaders = 8u;

// Whether all invocations of the subgroup are here with the same number, and are enough of them.
bool isShared(uint number) {
    return gl_SubgroupSize >= kReaders &&
           subgroupBallotBitCount(subgroupBallot(subgroupBroadcastFirst(number) == number)) == gl_SubgroupSize;
}

// Which of eight words in a row an invocation reads.
uint ownWord() { return gl_SubgroupInvocationID & (kReaders - 1u); }

// All of a glyph's coefficients; loadCoefficients() has asked isShared().
void loadSharedCoefficients(FloatBuffer source) {
    float own[(SH_COUNT + kReaders - 1u) / kReaders];
    for (uint i = 0u; i < own.length(); ++i) own[i] = source.at[min(kReaders * i + ownWord(), kUsed - 1u)];
#define SHARED_SOURCE(i) subgroupBroadcast(own[(i) / kReaders], (i) % kReaders)
    SH_LOAD(SHARED_SOURCE, kUsed, glyph_coefficients)
}

layout(buffer_reference, scalar) readonly buffer InstanceWordBuffer { uint at[]; };

GlyphInstance sharedInstance(uint64_t instances, uint index) {
    InstanceWordBuffer source = InstanceWordBuffer(instances);
    const uint own0 = source.at[16u * index + ownWord()], own1 = source.at[16u * index + kReaders + ownWord()];
#define SHARED_WORD(i) ((i) < kReaders ? subgroupBroadcast(own0, (i) % kReaders) : subgroupBroadcast(own1, (i) % kReaders))
#define SHARED_FLOAT(i) uintBitsToFloat(SHARED_WORD(i))
#define SHARED_VECTOR(i) vec3(SHARED_FLOAT(i), SHARED_FLOAT(i + 1u), SHARED_FLOAT(i + 2u))
    return GlyphInstance(SHARED_VECTOR(0u), SHARED_FLOAT(3u), SHARED_VECTOR(4u), SHARED_FLOAT(7u), SHARED_VECTOR(8u), SHARED_WORD(11u),
                         SHARED_VECTOR(12u), 0u);
}
