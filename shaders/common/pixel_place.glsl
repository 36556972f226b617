// Column and row of a number that counts row by row. CPU drivers divide integers lane by lane, so the quotient is one of floats.
#ifndef RADIATA_COMMON_PIXEL_PLACE
#define RADIATA_COMMON_PIXEL_PLACE
#include "shaders/common/whole_number.glsl"

// \param at  below 2^31, in at most 2^20 rows: then the row is off by 1 at most, which the remainder shows. Exact.
ivec2 pixelPlace(uint at, uint width) {
    const int columns = int(width);
    const int row = wholeNumber(float(int(at)) / float(columns)), column = int(at) - row * columns;
    const int slip = column < 0 ? -1 : (column >= columns ? 1 : 0);
    return ivec2(column - slip * columns, row + slip);
}

#endif
