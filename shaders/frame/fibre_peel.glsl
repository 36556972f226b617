// Transparent fibres: segments are composed from the front, one per pixel and peel.
// Source: depth peeling, Everitt 2001, with words of depth and name in place of two depth tests, so that segments at equal depths
// are peeled one by one. Twin: server/reference/fibre_picture (all segments of a pixel by depth).
layout(buffer_reference, scalar) buffer FibletLayerBuffer { FibletLayerParams layer; };
layout(buffer_reference, scalar) buffer PeelWordBuffer { uint64_t at[]; };
layout(buffer_reference, scalar) buffer PeelCountsBuffer { FibletCounts counts; };

// Whether the segment goes on the one composed before it: where segments meet, or tubes of a fibre overlap, one surface is seen, not two.
bool sameStretch(FibletLayerParams layer, uint at, uint who, bool line) {
    const uint before = uint(PeelWordBuffer(layer.peeled).at[at]);
    const bool paged = (kPagedLayers >> layer.layer & 1u) != 0u;
    const uint64_t heads = paged ? layer.places : layer.heads;
    const FibletHead a = headOf(heads, paged, before >> FIBLET_SEGMENT_BITS), b = headOf(heads, paged, who >> FIBLET_SEGMENT_BITS);
    const uint mask = (1u << FIBLET_SEGMENT_BITS) - 1u;
    const int way = int(FIBLET_SEGMENTS) * (int(a.shape >> 20u) - int(b.shape >> 20u)) + int(before & mask) - int(who & mask);
    const int reach = line ? 2 : 2 + int(ceil(2.0 * layer.view.tube_radius / layer.codec.step_mm));
    return a.fibre == b.fibre && abs(way) <= reach;
}

// The veil with the segment behind it. \param counts  a segment of a stretch that is in the veil already does not
// \param tail  the segment stands for all that are left
vec4 peeled(FibletLayerParams layer, vec4 veil, uint at, vec3 lit, float opacity, bool counts, bool tail) {
    PeelWordBuffer(layer.peeled).at[at] = PeelWordBuffer(layer.words).at[at];
    if (counts) {
        veil.rgb += veil.a * opacity * lit;
        veil.a *= 1.0 - opacity;
    }
    if (tail) {
        const float left = min(veil.a, pow(1.0 - opacity, float(StateBuffer(layer.fragments).at[at])));
        veil.rgb += (veil.a - left) * lit;
        veil.a = left;
    }
    // What is left is less than half of an 8-bit step.
    if (veil.a > 1.0 / 512.0) atomicAdd(PeelCountsBuffer(layer.counts).counts.more, 1u);
    return veil;
}
