// What each pixel keeps of a transparent layer: the nearest segments that are not composed yet. A nearer one takes the place of the
// farthest that is kept, by a compare and swap: words in slots only get less, so what is the farthest when it is found is so when it is
// replaced, and in the end the least of all words are there, in whatever order they came; sheet.comp sorts them.
// Slot i of a pixel is at i times the pixels, as passes over the picture read one slot of each. Included where kChain, the slots of
// a pixel, is known.
// Source: the k-buffer of Bavoil et al. 2007, with the order's depth and name in one word in place of a lock.
// Twin: server/reference/fibre_picture (all segments of a pixel by depth).

layout(buffer_reference, scalar) coherent buffer ChainBuffer { ChainSlot at[]; };
layout(buffer_reference, scalar) buffer LimitBuffer { uint at[]; };

// Names nobody: who stands there has to be drawn again.
const uint64_t kUnnamed = uint64_t(FIBLET_NOBODY);

// Who is replaced may write its direction last; then the name is wrong, which is found later, as in `tangents`. A word that is there
// already gets its direction and nothing else.
// \param pixels  of the picture \param limits  orders of depths behind which nothing is kept \param named  direction << 32 | who
void keepInChain(ChainBuffer chain, LimitBuffer limits, uint pixels, uint pixel, uint64_t word, uint64_t named) {
    while (true) {
        uint64_t most = 0ul, second = 0ul;
        uint slot = pixel;
        bool there = false;
        for (uint i = 0u; i < kChain; ++i) {
            const uint at = pixel + i * pixels;
            const uint64_t one = chain.at[at].word;
            const bool farther = one > most && !there;
            second = farther ? most : max(second, one);
            most = farther ? one : most;
            there = there || one == word;
            slot = farther || one == word ? at : slot;
        }
        if (!there) {
            if (word > most) return;
            if (atomicCompSwap(chain.at[slot].word, most, word) != most) continue;
            atomicMin(limits.at[pixel], uint(max(second, word) >> 32));
        }
        chain.at[slot].named = named;
        return;
    }
}
