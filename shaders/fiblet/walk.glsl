// A walk along a fiblet's points, one segment after the other.
#include "shaders/common/fiblet_decode.glsl"

struct FibletWalk {
    FibletPen pen;
    uint fibre;
    uint segments;
    uint width;
    uint word;
    float ratio;
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
    return walk;
}

FibletWalk beginWalk(FibletLayerParams layer, uint fiblet) {
    return beginWalkAt(layer, HeadBuffer(layer.heads).at[fiblet], PageBuffer(layer.pages).at[fiblet / FIBLET_PAGE].first_word);
}

// To the end of segment i, counted from 0.
void stepWalk(FibletLayerParams layer, inout FibletWalk walk, uint i) {
    FibletCodes codes = FibletCodes(layer.codes);
    if (i > 0u) fibletTurn(walk.pen, fibletCode(codes, walk.word, i - 1u, walk.width), walk.width, walk.ratio);
    fibletMove(walk.pen, fibletLength(walk.head, codes, walk.word, i + 1u, layer.codec.step_mm));
}
