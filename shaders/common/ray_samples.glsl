// Points of the unit square for the secondary rays of a pixel: one low-discrepancy sequence, moved by a fixed amount in each pixel.
// Equal requests give equal rays; the rays of later samples of the picture go on where the earlier ones ended.
// Source: Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences" (R2); shifts after Cranley and Patterson 1976, from
// the PCG hash of Jarzynski and Olano 2020. Twin: server/reference/ray_samples.
#ifndef RADIATA_COMMON_RAY_SAMPLES
#define RADIATA_COMMON_RAY_SAMPLES

uint hashed(uint x) {
    const uint state = x * 747796405u + 2891336453u;
    const uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// \param index  of the ray, counted over all samples of the picture; \param pixel  number of the pixel
// \return both in [0, 1), multiples of 2^-24. Whole numbers wrap exactly, so no digits are lost for a large index.
vec2 raySample(uint index, uint pixel) {
    const uint shift = hashed(pixel);
    const uvec2 point = uvec2(shift, hashed(shift ^ 0x9e3779b9u)) + index * uvec2(3242174889u, 2447445414u);
    return vec2(point >> 8u) * (1.0 / 16777216.0);
}

#endif
