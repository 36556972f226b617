// Ray parameters as depths of a 32-bit float depth image, without loss. The depth test must order hits as their parameters do, to
// the last bit, and parameters may be negative; so the floats of magnitude 2^-31 to 2^31 mm of either sign, and zero, are numbered
// in order and the numbers are taken as bit patterns of floats from 2^-125 to 1/2. A nearer hit has a greater depth; 0 is left for
// nothing. Smaller magnitudes become 0, larger ones 2^31.
#ifndef RADIATA_COMMON_DEPTH_CODE
#define RADIATA_COMMON_DEPTH_CODE

const uint kLeastMagnitude = 0x30000000u;     // bits of 2^-31
const uint kGreatestMagnitude = 0x4effffffu;  // bits of the last float below 2^31
const int kDepthOfZero = 0x20000000;

float depthOfParameter(float t) {
    const uint magnitude = min(floatBitsToUint(abs(t)), kGreatestMagnitude);
    const int number = magnitude < kLeastMagnitude ? 0 : int(magnitude - kLeastMagnitude) + 1;
    return intBitsToFloat(kDepthOfZero - (t < 0.0 ? -number : number));
}

float parameterOfDepth(float depth) {
    const int number = kDepthOfZero - floatBitsToInt(depth);
    const float magnitude = number == 0 ? 0.0 : uintBitsToFloat(uint(abs(number) - 1) + kLeastMagnitude);
    return number < 0 ? -magnitude : magnitude;
}

#endif
