// Transparent layers: what is found nearest is composed, round by round from the front, and leaves its layer.
// Source: depth peeling, Everitt 2001; of fibres with words of depth and name in place of two depth tests, so that segments at equal
// depths are peeled one by one. Twin: server/reference/fibre_picture (all segments of a pixel by depth).
#include "shaders/shared/peel.glsl"

layout(buffer_reference, scalar) buffer PeelBuffer { PeelParams peel; };
layout(buffer_reference, scalar) buffer FibletLayerBuffer { FibletLayerParams layer; };
layout(buffer_reference, scalar) buffer PeelWordBuffer { uint64_t at[]; };
layout(buffer_reference, scalar) buffer PeelGlyphBuffer { Surface at[]; };
layout(buffer_reference, scalar) buffer PeelFloatBuffer { float at[]; };

// Whether the segment goes on the one of its layer composed before it: where segments meet, or tubes of a fibre overlap, one
// surface is seen, not two.
bool sameStretch(FibletLayerParams layer, uint at, uint who, bool line) {
    const uint64_t word = PeelWordBuffer(layer.peeled).at[at];
    if (word == 0ul) return false;
    const uint before = uint(word);
    const bool paged = (kPagedLayers >> layer.layer & 1u) != 0u;
    const uint64_t heads = paged ? layer.places : layer.heads;
    const FibletHead a = headOf(heads, paged, before >> FIBLET_SEGMENT_BITS), b = headOf(heads, paged, who >> FIBLET_SEGMENT_BITS);
    const uint mask = (1u << FIBLET_SEGMENT_BITS) - 1u;
    const int way = int(FIBLET_SEGMENTS) * (int(a.shape >> 20u) - int(b.shape >> 20u)) + int(before & mask) - int(who & mask);
    const int reach = line ? 2 : 2 + int(ceil(2.0 * layer.view.tube_radius / layer.codec.step_mm));
    return a.fibre == b.fibre && abs(way) <= reach;
}

// Nothing of any layer of fibres is composed yet.
void beginPeels(PeelBuffer peels, uint at) {
    for (uint i = 0u; i < 8u; ++i) {
        if (peels.peel.fibres[i] != 0ul) PeelWordBuffer(FibletLayerBuffer(peels.peel.fibres[i]).layer.peeled).at[at] = 0ul;
    }
}

// Takes what was found from its layer. \return  whether it counts: a segment of a stretch that is in the veil already does not
bool takePeel(PeelBuffer peels, uint at, Surface found, bool line) {
    const uint i = found.layer_and_steps >> 24u;
    if (peels.peel.glyphs[i] != 0ul) PeelGlyphBuffer(peels.peel.glyphs[i]).at[at].who = 0xffffffffu;
    if (peels.peel.crossings[i] != 0ul) PeelFloatBuffer(peels.peel.crossings[i]).at[at] = found.depth;
    if (peels.peel.fibres[i] == 0ul) return true;
    const FibletLayerParams layer = FibletLayerBuffer(peels.peel.fibres[i]).layer;
    const bool counts = !sameStretch(layer, at, found.who, line);
    PeelWordBuffer(layer.peeled).at[at] = PeelWordBuffer(layer.words).at[at];
    return counts;
}

// What all transparent layers together let through of what is opaque, as they were counted.
float throughPeels(PeelBuffer peels, LookBuffer looks, uint at) {
    float through = PeelFloatBuffer(peels.peel.rest).at[at];
    for (uint i = 0u; i < 8u; ++i) {
        if (peels.peel.fibres[i] == 0ul) continue;
        const uint64_t fragments = FibletLayerBuffer(peels.peel.fibres[i]).layer.fragments;
        through *= pow(1.0 - looks.at[i].opacity, float(StateBuffer(fragments).at[at]));
    }
    return through;
}

// The veil with what was found behind it. \param counts  it is not in the veil already
// \param tail  it stands for all that are left
vec4 peeled(PeelBuffer peels, LookBuffer looks, vec4 veil, uint at, vec3 lit, float opacity, bool counts, bool tail) {
    if (counts) {
        veil.rgb += veil.a * opacity * lit;
        veil.a *= 1.0 - opacity;
    }
    if (tail) {
        const float left = min(veil.a, throughPeels(peels, looks, at));
        veil.rgb += (veil.a - left) * lit;
        veil.a = left;
    }
    // What is left is less than half of an 8-bit step.
    if (veil.a > 1.0 / 512.0) atomicAdd(peels.peel.more, 1u);
    return veil;
}
