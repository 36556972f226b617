// The segments of a fiblet that are shown, one after the other. Included by raster.comp, where drawing is declared.
// Most segments are shorter than a pixel and have none. On a CPU driver a branch that goes another way than foreseen costs as much as
// decoding a segment, because what was decoded ahead of it is lost; so some segments are looked at together without a branch, their
// pixels and the depths there included, and the turns of the next ones are found meanwhile.

// Segments that are looked at together: up to four, in a group of segments that may become one line.
const uint kBatch = kDetail == 0u || kDetail >= 4u ? 4u : kDetail;
// Lines whose pixel, if they have one at most, shortLine() finds.
const bool kShortLines = kLines && !kTubes && kCuts == 0u && !kExactWidth;
// What lies behind the depth of its pixel has no effect.
const bool kNearest = !kCounting && !kFinding;
// Of tubes that let light through, what is inside of a neighbour is left out; what a mesh cuts out of it hides nothing.
const bool kJoins = kChain != 0u && kTubes && !kMeshCut;

// Whether a line from a to b can have a pixel. \param a, b  places in the picture of points that are not before the near plane
bool mayHavePixel(vec2 a, vec2 b) {
    const vec2 along = abs(b - a);
    const vec2 ends = along.x >= along.y ? vec2(a.x, b.x) : vec2(a.y, b.y);
    // What drawLine() finds may be off by rounding.
    return ceil(min(ends.x, ends.y) - 0.501) < ceil(max(ends.x, ends.y) - 0.499);
}

// Column and row in the whole picture.
vec2 placeOf(vec4 eye) { return kParallel ? vec2(view.centre.x + eye.x, view.centre.y - eye.y) : fibletPixel(view, eye); }

struct ShortLine {
    bool known;  // false: drawLine() has to look
    bool drawn;
    uint pixel;
    float depth;
};

// The pixel of a line that has one at most: what drawLine() finds. \param a, b  eye points of the ends
// \param pixel_a, pixel_b  their places in the picture
ShortLine shortLine(vec4 a, vec4 b, vec2 pixel_a, vec2 pixel_b) {
    const vec2 along = pixel_b - pixel_a;
    const bool columns = abs(along.x) >= abs(along.y);
    const vec2 from = columns ? pixel_a : pixel_a.yx, way = columns ? along : along.yx;
    const float to = columns ? pixel_b.x : pixel_b.y;
    const float begin = ceil(min(from.x, to) - 0.5), end = ceil(max(from.x, to) - 0.5);
    const float share = clamp((begin + 0.5 - from.x) / way.x, 0.0, 1.0);
    const float across = floor(from.y + share * way.y);
    // Where rays are parallel the quotient is `share` itself, to the last bit.
    const float s = kParallel ? share : share * a.w / (share * a.w + (1.0 - share) * b.w);
    const vec2 place = columns ? vec2(begin, across) : vec2(across, begin);
    const vec2 first = vec2(view.window_x, view.window_y), past = vec2(view.window_x + view.width, view.window_y + view.height);
    ShortLine line;
    line.depth = a.z + s * (b.z - a.z);
    line.known = min(a.z, b.z) >= view.near_depth && (begin >= end || (end - begin <= 1.0 && view.line_width == 1.0));
    line.drawn = line.known && begin < end && all(greaterThanEqual(place, first)) && all(lessThan(place, past)) &&
                 line.depth <= view.far_depth;
    const uint pixel = uint((wholeNumber(place.y) - view.window_y) * view.width + (wholeNumber(place.x) - view.window_x));
    line.pixel = line.drawn ? pixel : 0u;
    return line;
}

// Where the order of the depth is behind which nothing has an effect: a limit, or the upper half of a word.
uint nearestAt(uint pixel) { return kChain != 0u ? pixel : 2u * pixel + 1u; }

bool isShown(FibletWalk walk, uint i) {
    return i < walk.segments && (!kSegments || (shown >> i & 1ul) != 0ul);
}

// \param first  of the segments, a multiple of kBatch; `walk` has come so far
void drawWalk(FibletLayerParams layer, FibletWalk walk, uint first, uint end, uint fiblet, bool tube, bool line) {
    UintBuffer nearest = UintBuffer(kChain != 0u ? layer.limits : layer.words);
    vec3 points[kBatch + 1u], ways[kBatch];
    vec4 eyes[kBatch + 1u], turns[kBatch];
    vec2 pixels[kBatch + 1u];
    vec3 way_before = vec3(0.0);
    points[kBatch] = walk.pen.point;
    eyes[kBatch] = fibletEyePoint(view, walk.pen.point);
    pixels[kBatch] = placeOf(eyes[kBatch]);
    uvec2 codes = batchCodes(layer, walk, first);
    for (uint j = 0u; j < kBatch; ++j) turns[j] = fibletCodeTurn(batchCode(walk, codes, j), walk.width, walk.ratio);
    codes = batchCodes(layer, walk, first + kBatch);
    for (uint segment = first; segment < end; segment += kBatch) {
        points[0] = points[kBatch];
        eyes[0] = eyes[kBatch];
        pixels[0] = pixels[kBatch];
        uint drawn = 0u, others = 0u;  // bit j: segment + j is to be drawn, in one pixel or by drawSegments()
        uint places[kBatch];
        float depths[kBatch];
        for (uint j = 0u; j < kBatch; ++j) {
            ways[j] = fibletAxis(walk.pen.frame);
            walk.pen.point += (segment + j + 1u == walk.segments ? walk.last_length : layer.codec.step_mm) * ways[j];
            walk.pen.frame = fibletProduct(walk.pen.frame, turns[j]);
            turns[j] = fibletCodeTurn(batchCode(walk, codes, j), walk.width, walk.ratio);
            points[j + 1u] = walk.pen.point;
            eyes[j + 1u] = fibletEyePoint(view, walk.pen.point);
            pixels[j + 1u] = placeOf(eyes[j + 1u]);
            bool shows = segment + j < end;
            if (kSegments) shows = shows && (shown >> (segment + j) & 1ul) != 0ul;
            if (kShortLines) {
                const ShortLine one = shortLine(eyes[j], eyes[j + 1u], pixels[j], pixels[j + 1u]);
                places[j] = one.pixel;
                depths[j] = one.depth;
                // Read without a branch: see main().
                const bool hidden = kNearest && nearest.at[nearestAt(one.pixel)] < orderOfDepth(one.depth);
                drawn |= uint(shows && one.drawn && !hidden) << j;
                others |= uint(shows && !one.known) << j;
            } else {
                const bool anywhere = kTubes || kCuts != 0u || min(eyes[j].z, eyes[j + 1u].z) < view.near_depth;
                others |= uint(shows && (anywhere || mayHavePixel(pixels[j], pixels[j + 1u]))) << j;
            }
        }
        codes = batchCodes(layer, walk, segment + 2u * kBatch);
        const uint who = fiblet << FIBLET_SEGMENT_BITS | segment;
        while (kShortLines && drawn != 0u) {
            const uint j = uint(findLSB(drawn));
            drawn &= drawn - 1u;
            uint place = places[0];
            float depth = depths[0];
            vec3 way = ways[0];
            for (uint k = 1u; k < kBatch; ++k) {
                place = j == k ? places[k] : place;
                depth = j == k ? depths[k] : depth;
                way = j == k ? ways[k] : way;
            }
            mark(place, depth, who + j, way, vec3(0.0), kNearest);
        }
        while (others != 0u) {
            const uint j = uint(findLSB(others));
            others &= others - 1u;
            vec3 a = points[0], b = points[1];
            for (uint k = 1u; k < kBatch; ++k) {
                a = j == k ? points[k] : a;
                b = j == k ? points[k + 1u] : b;
            }
            Joints joints = kNoJoints;
            if (kJoins) {
                const uint next = segment + kBatch;
                vec3 before = way_before;
                vec3 after = (next + 1u == walk.segments ? walk.last_length : layer.codec.step_mm) * fibletAxis(walk.pen.frame);
                for (uint k = 1u; k < kBatch; ++k) {
                    before = j == k ? points[k - 1u] - points[k] : before;
                    after = j == k - 1u ? points[k + 1u] - points[k] : after;
                }
                if (isShown(walk, segment + j - 1u)) joints.before = before;
                if (isShown(walk, segment + j + 1u)) joints.after = after;
            }
            drawSegments(layer, a, b, fibletEyePoint(view, a), fibletEyePoint(view, b), who + j, 1u, tube, line, joints);
        }
        if (kJoins) way_before = points[kBatch - 1u] - points[kBatch];
    }
}
