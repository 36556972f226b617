// Whole numbers from floats. CPU drivers convert lane by lane; a sum with 1.5 * 2^23 leaves the number in the low bits of the float.
#ifndef RADIATA_COMMON_WHOLE_NUMBER
#define RADIATA_COMMON_WHOLE_NUMBER

// The nearest, of two as near the even one. \param x  within 2^22
int wholeNumber(float x) {
    precise const float marked = x + 12582912.0;
    return floatBitsToInt(marked) - floatBitsToInt(12582912.0);
}

#endif
