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

// To the end of segment i, counted from 0; one after the other.
void stepWalk(FibletLayerParams layer, inout FibletWalk walk, uint i) {
    if (i > 0u) {
        const uint bit = (i - 1u) * walk.width, shift = bit & 31u;
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
    fibletMove(walk.pen, i + 1u == walk.segments ? walk.last_length : layer.codec.step_mm);
}
