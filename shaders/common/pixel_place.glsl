// Column and row of a number that counts row by row. CPU drivers divide integers, and convert floats to them, lane by lane; so the
// quotient is one of floats, and its integer is read from the bits that it has beside 2^23.
#ifndef RADIATA_COMMON_PIXEL_PLACE
#define RADIATA_COMMON_PIXEL_PLACE

// \param at  below 2^31, in at most 2^20 rows: then the row is off by 1 at most, which the remainder shows. Exact.
ivec2 pixelPlace(uint at, uint width) {
    const int columns = int(width);
    precise const float quotient = float(int(at)) / float(columns);
    precise const float marked = quotient + 8388608.0;
    const int row = floatBitsToInt(marked) - floatBitsToInt(8388608.0), column = int(at) - row * columns;
    const int slip = column < 0 ? -1 : (column >= columns ? 1 : 0);
    return ivec2(column - slip * columns, row + slip);
}

#endif
