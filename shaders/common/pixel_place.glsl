// Column and row of a number that counts row by row. CPU drivers divide integers lane by lane; a quotient of floats costs a fraction.
#ifndef RADIATA_COMMON_PIXEL_PLACE
#define RADIATA_COMMON_PIXEL_PLACE

// \param at  below 2^31, in at most 2^20 rows: then the quotient is off by less than 1, which the remainder shows. Exact.
ivec2 pixelPlace(uint at, uint width) {
    const int columns = int(width), row = int((float(int(at)) + 0.5) / float(columns)), column = int(at) - row * columns;
    const int slip = column < 0 ? -1 : (column >= columns ? 1 : 0);
    return ivec2(column - slip * columns, row + slip);
}

#endif
