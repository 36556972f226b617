// How depths around a pixel shape what is seen of a fibre. Twins: server/reference/fibre_depth_cues.
#ifndef RADIATA_COMMON_FIBRE_DEPTH_CUES
#define RADIATA_COMMON_FIBRE_DEPTH_CUES

const uint kCueSamples = 16u;

// How much a neighbour that is nearer by `ahead` mm takes of the light, 0 to 1: all of it at `scale` mm, less again far before,
// where it is another structure. Source: the falloff of Eichelbaum et al. 2013 (LineAO), Sec. 4, in one term.
float cueOcclusion(float ahead, float scale) {
    const float near = clamp(ahead / scale, 0.0, 1.0), far = ahead / (8.0 * scale);
    return near / (1.0 + far * far);
}

// Pixels around a nearer fibre within which one `ahead` mm behind it is hidden. Source: Everts et al. 2009, Sec. 3: halos are
// narrower the closer fibres are. \param width  pixels \param gap  mm up to which fibres of a bundle are left alone
float haloRadius(float ahead, float width, float gap) { return width * clamp((ahead - gap) / (4.0 * gap), 0.0, 1.0); }

// Places of a disc that fill it evenly (Vogel 1979). \param turn  radians
vec2 cuePlace(uint i, float radius, float turn) {
    const float angle = float(i) * 2.39996323 + turn;
    return radius * sqrt((float(i) + 0.5) / float(kCueSamples)) * vec2(cos(angle), sin(angle));
}

#endif
