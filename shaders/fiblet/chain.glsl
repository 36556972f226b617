// What each pixel keeps of a transparent layer: the nearest segments that are not composed yet, as words in order. A word goes from
// slot to slot and stays where it is less than what stands there, which goes on in its place; so in the end the least are there,
// in whatever order they came. Slot i of a pixel is at i times the pixels, as passes over the picture read one slot of each.
// Included where kChain, the slots of a pixel, is known.
// Source: the loop over atomic minima of 64 bits in Kubisch 2014 (Order Independent Transparency in OpenGL 4.x, GTC).
// Twin: server/reference/fibre_picture (all segments of a pixel by depth).

layout(buffer_reference, scalar) buffer ChainBuffer { ChainSlot at[]; };

// Names nobody: who stands there has to be drawn again.
const uint64_t kUnnamed = uint64_t(FIBLET_NOBODY);

// Directions go along with their words as far as their names tell that they belong together; what another wrote in between leaves
// a wrong name, which is found later, as in `tangents`. A word that is there already gets its direction and nothing else.
// \param pixels  of the picture \param named  direction << 32 | who
void keepInChain(ChainBuffer chain, uint pixels, uint pixel, uint64_t word, uint64_t named) {
    for (uint at = pixel, end = kChain * pixels; at < end; at += pixels) {
        // What stands in a slot only gets less.
        if (chain.at[at].word < word) continue;
        const uint64_t stood = atomicMin(chain.at[at].word, word);
        if (stood < word) continue;
        const uint64_t had = chain.at[at].named;
        chain.at[at].named = named;
        // The limit, where nobody stands, is in all slots behind.
        if (stood == word || uint(stood) == FIBLET_NOBODY) return;
        word = stood;
        named = uint(had) == uint(stood) ? had : kUnnamed;
    }
}
