// Draws fiblets into words of 64 bits a pixel, the order of depths above who is seen: one invocation per fiblet walks along its
// points and rasterises segment by segment, and an atomic minimum keeps the nearest, of equal depths the lower fiblet and
// segment. So the picture does not depend on what ran in parallel.
// A segment is drawn in the pixels whose centres it passes along its longer axis, ends half open, so that the segments of a
// fibre meet without gap or overlap along that axis. Tubes are capsules whose pixels are cast one by one.
// Source of the key: Schuetz et al. 2021 (compute rasterisation of points); of lines: DDA with the centre rule of Bresenham.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/invocation.glsl"
#include "shaders/common/whole_number.glsl"
#include "shaders/fiblet/layer.glsl"
#include "shaders/fiblet/walk.glsl"
#include "shaders/common/fibre_directions.glsl"
#include "shaders/common/capsule.glsl"
#include "shaders/common/fiblet_detail.glsl"
#include "shaders/common/fiblet_places.glsl"

layout(constant_id = 1) const bool kParallel = false;  // rays are: nearness is 1 everywhere
layout(constant_id = 2) const uint kCuts = 0u;
layout(constant_id = 3) const bool kTubes = false;   // selected fibres as capsules
layout(constant_id = 4) const bool kLines = true;    // the others as lines
layout(constant_id = 5) const bool kSelection = false;  // fibres have states
layout(constant_id = 7) const bool kSegments = false;     // single segments are left out
layout(constant_id = 8) const bool kExactWidth = false;   // lines have their width across, not along a column or row
layout(constant_id = 9) const bool kPeel = false;         // only what lies behind the segment composed last
layout(constant_id = 10) const bool kCounting = false;    // segments before what is opaque are counted
layout(constant_id = 11) const bool kFinding = false;     // fibres in an outline are noted, nothing is drawn
layout(constant_id = 6) const bool kSelectedOnly = false;  // tubes of selected fibres; false: of all
layout(constant_id = 12) const uint kDetail = 0u;        // segments that may become one line; 0: none do
layout(constant_id = 13) const bool kSmallAsLines = false;  // fiblets of a few pixels are lines from end to end
layout(constant_id = 14) const bool kMeshCut = false;      // by the depths of a mesh's faces
layout(constant_id = 15) const bool kMeshOutside = false;  // what is not between them is shown; else what is
layout(constant_id = 16) const bool kPaged = false;  // some of the fiblets are on the device
layout(constant_id = 17) const uint kChain = 0u;     // slots of each pixel of a transparent layer; 0: nearest segments alone
#include "shaders/fiblet/chain.glsl"

layout(push_constant, scalar) uniform Push {
    LayerBuffer layer;
    UintBuffer list;  // fiblets to draw; null: all in their order
    uint first;       // of the list, or of all fiblets
    uint count;
} push;

FibletView view;
WordBuffer words, tangents, peeled;
ChainBuffer chain;
LimitBuffer limits;
uint chains;  // pixels of the picture
UintBuffer fragments, inside, found, cut_front, cut_back;
uint fibre;
uint64_t shown = 0ul;  // bit i: segment i is

// Tangents are not part of the minimum: who writes last may have lost. They name who wrote them, and surface.comp has those drawn
// again that do not name the winner; a second drawing finds the final words, so only winners write.
// \param word  order of the depth above who is seen \param direction  as packLine() or packTube() has it
void keep(uint pixel, uint64_t word, uint direction) {
    const uint64_t named = uint64_t(direction) << 32 | uint(word);
    if (kChain != 0u) {
        keepInChain(chain, limits, chains, pixel, word, named);
        return;
    }
    if (atomicMin(words.at[pixel], word) < word) return;
    tangents.at[pixel] = named;
}

// \param looked  nothing nearer was there a moment ago
void mark(uint pixel, float depth, uint who, vec3 along, vec3 normal, bool looked) {
    if (kMeshCut) {
        const uint order = orderOfDepth(depth), front = cut_front.at[pixel];
        // From inside of the mesh no front face is seen.
        const bool between = (front == FIBLET_NOBODY || front <= order) && order <= cut_back.at[pixel];
        if (between == kMeshOutside) return;
    }
    if (kFinding) {
        const bool counts = (inside.at[pixel >> 5u] >> (pixel & 31u) & 1u) != 0u;
        if (counts && (found.at[fibre >> 5u] >> (fibre & 31u) & 1u) == 0u) atomicOr(found.at[fibre >> 5u], 1u << (fibre & 31u));
        return;
    }
    const uint64_t word = uint64_t(orderOfDepth(depth)) << 32 | who;
    if (kPeel && word <= peeled.at[pixel]) return;
    if (kCounting && word <= peeled.at[pixel]) atomicAdd(fragments.at[pixel], 1u);
    // What lies behind all that is kept costs one read.
    if (!looked && (kChain != 0u ? limits.at[pixel] < uint(word >> 32) : words.at[pixel] < word)) return;
    keep(pixel, word, kTubes && dot(normal, normal) > 0.0 ? packTube(along, normal) : packLine(along));
}

void noteError(FibletLayerParams layer, float error) {
    if (error > 0.0) atomicMax(CountsBuffer(layer.counts).counts.error_px, floatBitsToUint(error));
}

// \param a, b   eye points of the ends, clipped to the near plane \param count  segments from `who` on that the line stands for
// \param share  of the line that was drawn, from end to end
void drawLine(vec4 a, vec4 b, uint who, uint count, vec2 shares, vec3 way) {
    const vec2 pixel_a = fibletPixel(view, a), pixel_b = fibletPixel(view, b);
    const vec2 along = pixel_b - pixel_a;
    const bool columns = abs(along.x) >= abs(along.y);
    const vec2 from = columns ? pixel_a : pixel_a.yx, to = columns ? pixel_b : pixel_b.yx;
    const ivec2 size = columns ? ivec2(view.width, view.height) : ivec2(view.height, view.width);
    const ivec2 origin = columns ? ivec2(view.window_x, view.window_y) : ivec2(view.window_y, view.window_x);
    // Bounded before the conversion to integers: ends may be far outside.
    const float low = clamp(min(from.x, to.x), float(origin.x) - 1.0, float(origin.x + size.x) + 1.0);
    const float high = clamp(max(from.x, to.x), float(origin.x) - 1.0, float(origin.x + size.x) + 1.0);
    const int begin = max(wholeNumber(ceil(low - 0.5)), origin.x), end = min(wholeNumber(ceil(high - 0.5)), origin.x + size.x);
    const int width = wholeNumber(view.line_width);
    // Half of what a strip of the line's width takes of a column that it crosses at a slant.
    const float slope = (to.y - from.y) / max(abs(to.x - from.x), 1e-6);
    const float half_strip = 0.5 * view.line_width * sqrt(1.0 + slope * slope);
    if (begin >= end) return;
    int i = begin;
    do {
        const float share = clamp((float(i) + 0.5 - from.x) / (to.x - from.x), 0.0, 1.0);
        const float across = from.y + share * (to.y - from.y);
        // Depth is linear in space, not in the picture.
        const float s = share * a.w / (share * a.w + (1.0 - share) * b.w);
        const float depth = a.z + s * (b.z - a.z);
        uint here = who;
        if (kDetail != 0u || kSmallAsLines) here += min(uint(mix(shares.x, shares.y, s) * float(count)), count - 1u);
        const float place = clamp(across, -1e6, 1e6);
        int first = wholeNumber(floor(place - 0.5 * float(width - 1))) - origin.y, past = first + width;
        if (kExactWidth) {
            first = wholeNumber(ceil(place - half_strip - 0.5)) - origin.y;
            past = wholeNumber(ceil(place + half_strip - 0.5)) - origin.y;
        }
        first = max(first, 0);
        past = min(past, size.y);
        if (depth <= view.far_depth && abs(across) < 1e6 && first < past) {
            do {
                const ivec2 at = columns ? ivec2(i - origin.x, first) : ivec2(first, i - origin.x);
                mark(uint(at.y * view.width + at.x), depth, here, way, vec3(0.0), false);
            } while (++first < past);
        }
    } while (++i < end);
}

// Ways from a segment's ends to the other ends of its neighbours; zero where none is drawn.
struct Joints {
    vec3 before;
    vec3 after;
};
const Joints kNoJoints = Joints(vec3(0.0), vec3(0.0));

// Whether a hit on a capsule is inside of a neighbour, so that the ray is in the tube already.
bool isInside(vec3 from, vec3 along, Joints joints, vec3 hit, vec3 normal) {
    const float share = clamp(dot(hit - from, along) / max(dot(along, along), 1e-30), 0.0, 1.0);
    // From the normal, which has more digits.
    const vec3 outwards = view.tube_radius * normal;
    return insideCapsule(outwards + share * along, joints.before, view.tube_radius) ||
           insideCapsule(outwards + (share - 1.0) * along, joints.after, view.tube_radius);
}

// \param p, along  from the fiblets' origin: an end, and the way to the other
void drawTube(vec3 p, vec3 along, uint who, Joints joints) {
    const FibletFootprint footprint = fibletFootprint(view, min(p, p + along), max(p, p + along), 0.0, view.tube_radius);
    if (!footprint.seen) return;
    const vec3 from = (p - view.reference_high) - view.reference_low;
    const vec3 right = view.right / dot(view.right, view.right), up = view.up / dot(view.up, view.up);
    const uint nearest = orderOfDepth(footprint.nearest);
    for (int y = footprint.pixels.y; y <= footprint.pixels.w; ++y) {
        for (int x = footprint.pixels.x; x <= footprint.pixels.z; ++x) {
            const uint pixel = uint(y * view.width + x);
            if (kChain != 0u && !kCounting && limits.at[pixel] < nearest) continue;
            const vec2 place = vec2(float(x + view.window_x) + 0.5 - view.centre.x, view.centre.y - float(y + view.window_y) - 0.5);
            const vec3 origin = place.x * right + place.y * up;
            const vec3 direction = origin * view.inverse_distance + view.forward;  // its parameter is the depth
            vec3 normal;
            const float depth = capsuleHit(origin, direction, from, along, view.tube_radius, view.near_depth, normal);
            if (depth > view.far_depth) continue;
            // Opaque, it is hidden.
            if (kChain != 0u && isInside(from, along, joints, origin + depth * direction, normal)) continue;
            mark(pixel, depth, who, along, normal, false);
        }
    }
}

// Cuts the segment to depths from the near plane on. \param shares  of the whole line at a and b \return  false: nothing is left
bool clipToNear(inout vec4 a, inout vec4 b, inout vec2 shares) {
    if (min(a.z, b.z) >= view.near_depth) return true;
    if (!(max(a.z, b.z) >= view.near_depth)) return false;
    const float at = (view.near_depth - a.z) / (b.z - a.z), share = mix(shares.x, shares.y, at);
    const vec4 crossing = mix(a, b, at);
    if (a.z < view.near_depth) {
        a = crossing;
        shares.x = share;
    } else {
        b = crossing;
        shares.y = share;
    }
    return true;
}

// Cuts the segment to the layer's half spaces. \return  false: nothing is left
bool cutSegment(FibletLayerParams layer, inout vec3 a, inout vec3 b, inout vec2 shares) {
    for (uint i = 0u; i < kCuts; ++i) {
        const float out_a = dot(layer.cuts[i].normal, a) - layer.cuts[i].offset;
        const float out_b = dot(layer.cuts[i].normal, b) - layer.cuts[i].offset;
        if (out_a > 0.0 && out_b > 0.0) return false;
        if (out_a > 0.0 || out_b > 0.0) {
            const float at = out_a / (out_a - out_b), share = mix(shares.x, shares.y, at);
            const vec3 crossing = mix(a, b, at);
            if (out_a > 0.0) {
                a = crossing;
                shares.x = share;
            } else {
                b = crossing;
                shares.y = share;
            }
        }
    }
    return true;
}

bool isCutOff(FibletLayerParams layer, vec3 point) {
    bool out_of = false;
    for (uint i = 0u; i < kCuts; ++i) out_of = out_of || dot(layer.cuts[i].normal, point) > layer.cuts[i].offset;
    return out_of;
}

// A line for `count` segments from `who` on. \param a, b  ends, from the fiblets' origin \param joints  of a tube
void drawSegments(FibletLayerParams layer, vec3 a, vec3 b, vec4 eye_a, vec4 eye_b, uint who, uint count, bool tube, bool line,
                  Joints joints) {
    const vec3 way = b - a;
    vec2 shares = vec2(0.0, 1.0);
    if (kCuts != 0u) {
        if (kChain != 0u) {
            if (isCutOff(layer, a) || isCutOff(layer, a + joints.before)) joints.before = vec3(0.0);
            if (isCutOff(layer, b) || isCutOff(layer, b + joints.after)) joints.after = vec3(0.0);
        }
        if (!cutSegment(layer, a, b, shares)) return;
        eye_a = fibletEyePoint(view, a);
        eye_b = fibletEyePoint(view, b);
    }
    if (kTubes && tube) drawTube(a, b - a, who, joints);
    if (kLines && line && clipToNear(eye_a, eye_b, shares)) drawLine(eye_a, eye_b, who, count, shares, way);
}

#include "shaders/fiblet/draw_walk.glsl"

// Groups of segments as one line each where that is within the bound.
void drawDetail(FibletLayerParams layer, inout FibletWalk walk, uint fiblet) {
    float worst = 0.0;
    for (uint first = 0u; first < walk.segments; first += kDetail) {
        const uint end = min(first + kDetail, walk.segments);
        const FibletWalk before = walk;
        for (uint segment = first; segment < end; ++segment) stepWalk(layer, walk, segment);
        const vec3 a = before.pen.point, b = walk.pen.point;
        const vec4 eye_a = fibletEyePoint(view, a), eye_b = fibletEyePoint(view, b);
        const float error = fibletChordError(view, eye_a, eye_b, float(end - first) * layer.codec.step_mm, distance(a, b), 0.0);
        if (error <= layer.detail_px) {
            worst = max(worst, error);
            drawSegments(layer, a, b, eye_a, eye_b, fiblet << FIBLET_SEGMENT_BITS | first, end - first, false, true, kNoJoints);
        } else {
            drawWalk(layer, before, first, end, fiblet, false, true);
        }
    }
    noteError(layer, worst);
}

// A whole fiblet without decoding it. \return  false: it has to be decoded
bool drawAsLine(FibletLayerParams layer, FibletWalk walk, uint fiblet) {
    const uint next = UintBuffer(layer.next).at[fiblet];
    if (next == FIBLET_NOBODY) return false;
    const vec3 a = walk.pen.point, b = fibletStart(HeadBuffer(layer.heads).at[next], layer.codec.cell_mm);
    const vec4 eye_a = fibletEyePoint(view, a), eye_b = fibletEyePoint(view, b);
    const float reach = float(walk.segments) * layer.codec.step_mm;
    const bool small = kSmallAsLines && fibletIsSmall(view, eye_a, reach);
    if (!small) {
        if (kDetail == 0u) return false;
        const float error = fibletChordError(view, eye_a, eye_b, reach, distance(a, b), layer.end_slack);
        if (!(error <= layer.detail_px)) return false;
        noteError(layer, error);
    }
    drawSegments(layer, a, b, eye_a, eye_b, fiblet << FIBLET_SEGMENT_BITS, walk.segments, false, true, kNoJoints);
    return true;
}

void main() {
    // Before the return: what all invocations read alike is one read on a CPU driver where all are active, and one for each elsewhere.
    const FibletLayerParams layer = push.layer.layer;
    if (globalInvocation() >= push.count) return;
    const uint at = push.first + globalInvocation();
    // Not a variant of the shader: what is drawn once more is listed, in few pictures.
    const uint fiblet = uint64_t(push.list) != 0ul ? push.list.at[at] : at;
    view = layer.view;
    words = WordBuffer(layer.words);
    tangents = WordBuffer(layer.tangents);
    if (kChain != 0u) {
        chain = ChainBuffer(layer.chain);
        limits = LimitBuffer(layer.limits);
        chains = uint(view.width * view.height);
    }
    if (kPeel || kCounting) peeled = WordBuffer(layer.peeled);
    if (kCounting) fragments = UintBuffer(layer.fragments);
    if (kMeshCut) {
        cut_front = UintBuffer(layer.cut_front);
        cut_back = UintBuffer(layer.cut_back);
    }
    FibletWalk walk;
    if (kPaged) {
        const FibletPlace place = PlaceBuffer(layer.places).at[fiblet / FIBLET_PAGE];
        if (!fibletHeld(place, fiblet % FIBLET_PAGE)) return;
        walk = beginWalkAt(layer, HeadBuffer(layer.heads).at[fibletHeldAt(place, fiblet % FIBLET_PAGE)], place.first_word);
    } else {
        walk = beginWalk(layer, fiblet);
    }
    fibre = walk.fibre;
    if (kFinding) {
        inside = UintBuffer(layer.inside);
        found = UintBuffer(layer.found);
    }
    bool tube = kTubes, line = kLines;
    if (kSelection) {
        const uint state = fibreState(layer, walk.fibre);
        if (state == FIBRE_HIDDEN) return;
        if (kTubes && kSelectedOnly) {
            tube = state == FIBRE_SELECTED;
            line = kLines && !tube;
        }
    }
    if (kSegments) {
        shown = WordBuffer(layer.segments).at[fiblet];
        if (shown == 0ul) return;
    }
    // What stands for many segments stands for all of them.
    const bool whole = !kSegments || (shown & (1ul << walk.segments) - 1ul) == (1ul << walk.segments) - 1ul;
    if ((kDetail != 0u || kSmallAsLines) && line && !tube && whole) {
        // Where the fibre goes on need not be on the device.
        if (!kPaged && drawAsLine(layer, walk, fiblet)) return;
        if (kDetail != 0u) {
            drawDetail(layer, walk, fiblet);
            return;
        }
    }
    drawWalk(layer, walk, 0u, walk.segments, fiblet, tube, line);
}
