// A walk along a fiblet's points, one segment after the other. Codes are read word by word, and what is the same at each point is
// found once: a read by address costs a CPU driver a branch per invocation.
#include "shaders/common/fiblet_decode.glsl"

struct FibletWalk {
    FibletPen pen;
    uint fibre;
    uint segments;
    uint width;
    uint word;
    float ratio;
    float last_length;  // of the last segment, mm
    uvec2 codes;        // the words that hold the next code
    FibletHead head;
};

// \param first_word  what its codes are counted from
FibletWalk beginWalkAt(FibletLayerParams layer, FibletHead head, uint first_word) {
    FibletWalk walk;
    walk.head = head;
    walk.pen = fibletBegin(walk.head, layer.codec);
    walk.fibre = walk.head.fibre;
    walk.segments = fibletSegments(walk.head);
    walk.width = fibletWidth(walk.head);
    walk.word = fibletWord(walk.head, first_word);
    walk.ratio = layer.codec.cap_ratio[fibletCap(walk.head)];
    walk.last_length = fibletLength(walk.head, FibletCodes(layer.codes), walk.word, walk.segments, layer.codec.step_mm);
    walk.codes = uvec2(0u);
    if (walk.segments > 1u) walk.codes.y = FibletCodes(layer.codes).word[walk.word];
    return walk;
}

FibletWalk beginWalk(FibletLayerParams layer, uint fiblet) {
    return beginWalkAt(layer, HeadBuffer(layer.heads).at[fiblet], PageBuffer(layer.pages).at[fiblet / FIBLET_PAGE].first_word);
}

// To the end of segment i, counted from 0, and in the direction of the next; one after the other.
void stepWalk(FibletLayerParams layer, inout FibletWalk walk, uint i) {
    const bool last = i + 1u == walk.segments;
    fibletMove(walk.pen, last ? walk.last_length : layer.codec.step_mm);
    if (last) return;
    const uint bit = i * walk.width, shift = bit & 31u;
    if (shift < walk.width) {
        // The code's first bit is in another word than that of the code before.
        const uint next = (bit >> 5u) + 1u;
        walk.codes.x = walk.codes.y;
        if (32u * next < (walk.segments - 1u) * walk.width) walk.codes.y = FibletCodes(layer.codes).word[walk.word + next];
    }
    // Twice, as a shift by 32 is not defined.
    const uint code = walk.codes.x >> shift | walk.codes.y << 1u << (31u - shift);
    fibletTurn(walk.pen, code & ((1u << walk.width) - 1u), walk.width, walk.ratio);
}

// The codes of up to four turns from that behind segment i on, for batchCode(). \param i  a multiple of the batch, which is 4, 2 or 1
uvec2 batchCodes(FibletLayerParams layer, FibletWalk walk, uint i) {
    uvec2 words = uvec2(0u);
    if (i + 1u < walk.segments) {
        const uint bit = i * walk.width, first = bit >> 5u, last = ((walk.segments - 1u) * walk.width - 1u) >> 5u;
        words.x = FibletCodes(layer.codes).word[walk.word + first];
        words.y = FibletCodes(layer.codes).word[walk.word + min(first + 1u, last)];
        // Four codes of up to 8 bits are in the first word then; of 16 bits the shift is 0, unless it is the only one or the other of a pair.
        words.x = words.x >> (bit & 31u) | words.y << 1u << (31u - (bit & 31u));
    }
    return words;
}

// \param j  of the batch, from 0 on
uint batchCode(FibletWalk walk, uvec2 codes, uint j) {
    const uint bit = j * walk.width;
    return (bit < 32u ? codes.x : codes.y) >> (bit & 31u) & ((1u << walk.width) - 1u);
}
