// Light through homogeneous media. Twin: server/reference/medium.
// Source: Peters et al. 2023, Sec. 4.3: T = exp(-sigma d), opacity 1 - T over a constant emission.
#ifndef RADIATA_COMMON_MEDIUM
#define RADIATA_COMMON_MEDIUM

// What is seen of `behind`. Media of one emission give the exact radiance in whatever order they lie and overlap; of several, their
// emissions are mixed by optical depth.
vec3 throughMedium(vec3 behind, vec3 weighted_emission, float optical_depth) {
    if (!(optical_depth > 0.0)) return behind;
    const float transmittance = exp(-optical_depth);
    return behind * transmittance + weighted_emission * ((1.0 - transmittance) / optical_depth);
}

#endif
