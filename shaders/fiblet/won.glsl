// What is noted of the fiblets that won pixels. Included where a layer's buffers are known.

// For the next picture's first phase of culling.
void markSeen(FibletLayerParams layer, uint who) {
    const uint fiblet = who >> FIBLET_SEGMENT_BITS, bit = 1u << (fiblet & 31u);
    if ((UintBuffer(layer.visible).at[fiblet >> 5u] & bit) == 0u) atomicOr(UintBuffer(layer.visible).at[fiblet >> 5u], bit);
}

// Its tangent is another's, who wrote last.
void drawAgain(FibletLayerParams layer, uint who) {
    const uint place = atomicAdd(CountsBuffer(layer.counts).counts.repaired, 1u);
    if (place < layer.list_size) UintBuffer(layer.list).at[place] = who >> FIBLET_SEGMENT_BITS;
}
