// From the bits of a fiblet to its points. Bit layout: shaders/shared/fiblet.glsl. In sequence:
//   FibletPen pen = fibletBegin(head, codec);              // pen.point is point 0
//   for (uint i = 1; i <= fibletSegments(head); ++i) {
//       if (i > 1) fibletTurn(pen, fibletCode(codes, word, i - 2, width), width, ratio);
//       fibletMove(pen, fibletLength(...));                // pen.point is point i
//   }
// In parallel: segment i is the rigid motion "turn by fibletCodeTurn, then go `length` along the new x axis"; the product of the
// first i motions, from the left, puts point i (Schertzer et al. 2022, Eq. 3; quaternions in place of matrices).
// Points are mm from the set's origin. Error against double precision: below 0.2 um (tests/gpu/functions/fiblet_test.cpp).
// Sources: Schertzer et al. 2022, App. B, with the square roots' quotient simplified so that there is no 0 / 0; the turn is the smallest
// rotation, whose half-angle form needs no division by what vanishes, so caps up to a half turn are well-defined.
#ifndef RADIATA_COMMON_FIBLET_DECODE
#define RADIATA_COMMON_FIBLET_DECODE
#include "shaders/shared/fiblet.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FibletCodes { uint word[]; };

uint fibletSegments(FibletHead head) { return head.shape & 63u; }
uint fibletWidth(FibletHead head) {
    const uint choice = (head.shape >> 6) & 3u;
    return choice == 3u ? 16u : 4u + 2u * choice;
}
bool fibletIsLast(FibletHead head) { return (head.shape & 256u) != 0u; }
bool fibletIsShortened(FibletHead head) { return (head.shape & 512u) != 0u; }
uint fibletWord(FibletHead head, uint page_first_word) { return page_first_word + 2u * ((head.shape >> 10) & 1023u); }
// Which of its fibre's fiblets it is; its point i is the fibre's point FIBLET_SEGMENTS * index + i.
uint fibletIndex(FibletHead head) { return head.shape >> 20; }
uint fibletCap(FibletHead head) { return head.place1 >> 28; }

vec3 fibletStart(FibletHead head, float cell_mm) {
    const uint x = head.place0 & 0xfffffu;
    const uint y = (head.place0 >> 20) | ((head.place1 & 0xffu) << 12);
    const uint z = (head.place1 >> 8) & 0xfffffu;
    return vec3(x, y, z) * cell_mm;
}

// Quaternions are (x, y, z, w).
vec4 fibletProduct(vec4 a, vec4 b) {
    return vec4(a.w * b.xyz + b.w * a.xyz + cross(a.xyz, b.xyz), a.w * b.w - dot(a.xyz, b.xyz));
}

// Where the rotation takes the x axis.
vec3 fibletAxis(vec4 q) {
    return vec3(1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + q.w * q.z), 2.0 * (q.x * q.z - q.w * q.y));
}

// The frame of the first segment: the smallest rotation of (X, Y, Z), or of (-X, -Y, Z) in the rear half, that points the x axis
// along the direction. The half is told from whole numbers, so all decoders agree.
vec4 fibletFirstFrame(uint direction) {
    ivec2 p = ivec2(int(direction << 16) >> 16, int(direction) >> 16);
    const int x = 32767 - abs(p.x) - abs(p.y);
    if (x < 0) p = ivec2(p.x < 0 ? -1 : 1, p.y < 0 ? -1 : 1) * (32767 - abs(p.yx));
    const vec3 d = normalize(vec3(x, p.x, p.y));
    const float w = sqrt(0.5 + 0.5 * abs(d.x));
    return x < 0 ? vec4(0.5 * d.z / w, 0.0, w, 0.5 * d.y / w) : vec4(0.0, -0.5 * d.z / w, 0.5 * d.y / w, w);
}

// `width` bits of codes from bit position `bit` after the word at `first`; width at most 16.
uint fibletBits(FibletCodes codes, uint first, uint bit, uint width) {
    const uint word = first + (bit >> 5), shift = bit & 31u;
    uint value = codes.word[word] >> shift;
    if (shift + width > 32u) value |= codes.word[word + 1] << (32u - shift);
    return value & ((1u << width) - 1u);
}

uint fibletCode(FibletCodes codes, uint first, uint number, uint width) { return fibletBits(codes, first, number * width, width); }

// Length of segment i, counted from 1, mm.
float fibletLength(FibletHead head, FibletCodes codes, uint first, uint i, float step_mm) {
    const uint segments = fibletSegments(head);
    if (i != segments || !fibletIsShortened(head)) return step_mm;
    return step_mm * (float(fibletBits(codes, first, (segments - 1u) * fibletWidth(head), 16u)) / 65535.0);
}

// The turn that a code stands for, as a rotation about an axis orthogonal to x.
// A code is a point of a square grid, the square a half octahedron, its directions a cap of turns by an area-preserving map.
vec4 fibletCodeTurn(uint code, uint width, float ratio) {
    const uint half_width = width >> 1;
    const int side = int((1u << half_width) - 1u);
    // Whole numbers: what lies on the cap's rim is exactly there, where the square root below is steep.
    const ivec2 q = 2 * ivec2(code & uint(side), code >> half_width) - side;
    const vec3 at = vec3(side - max(abs(q.x), abs(q.y)), 0.5 * float(q.x + q.y), 0.5 * float(q.x - q.y));
    // Of the direction d of `at`: s = sqrt(ratio / 2 / (1 + d.x)) / |at|, with one division in all.
    const float size = length(at), one = 1.0 / (size * (size + at.x));
    const float s = sqrt(0.5 * ratio * one), x = at.x * (size + at.x) * one;
    return vec4(0.0, -s * at.z, s * at.y, sqrt((1.0 - 0.5 * ratio) + 0.5 * ratio * x));
}

struct FibletPen {
    vec4 frame;
    vec3 point;
};

FibletPen fibletBegin(FibletHead head, FibletCodec codec) {
    return FibletPen(fibletFirstFrame(head.direction), fibletStart(head, codec.cell_mm));
}

void fibletTurn(inout FibletPen pen, uint code, uint width, float ratio) {
    pen.frame = fibletProduct(pen.frame, fibletCodeTurn(code, width, ratio));
}

void fibletMove(inout FibletPen pen, float length_mm) { pen.point += length_mm * fibletAxis(pen.frame); }

#endif
