// Depths as unsigned numbers that order as they do, whatever their sign: the nearer the smaller. All of a float's bits stay.
#ifndef RADIATA_COMMON_DEPTH_ORDER
#define RADIATA_COMMON_DEPTH_ORDER

uint orderOfDepth(float depth) {
    const uint bits = floatBitsToUint(depth);
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

float depthOfOrder(uint order) { return uintBitsToFloat((order & 0x80000000u) != 0u ? order & 0x7fffffffu : ~order); }

#endif
