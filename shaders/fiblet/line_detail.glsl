// Level of detail of the pipelines that have the device's rasteriser draw lines, by the rule of raster.comp
// (shaders/common/fiblet_detail.glsl): which segments become one line, and a whole fiblet without decoding it. A line that the
// rasteriser would have to clip at the frame's sides stands for one segment (line_end.glsl). To be included after line_end.glsl.
#include "shaders/common/fiblet_decode.glsl"
#include "shaders/common/fiblet_detail.glsl"

layout(constant_id = 9) const bool kSegments = false;       // some segments are left out
layout(constant_id = 10) const bool kDetail = false;        // lines may stand for many segments, as far as the layer says
layout(constant_id = 11) const bool kSmallAsLines = false;  // fiblets of a few pixels are lines from end to end

const bool kFewerLines = kDetail || kSmallAsLines;

// Points from the fiblets' origin, as they are and as fibletEyePoint() has them; segments of the fiblet that the line stands for.
struct FibletLine {
    vec3 a;
    vec3 b;
    vec4 eye_a;
    vec4 eye_b;
    uint first;
    uint count;
};

FibletLine fibletLine(FibletView view, vec3 a, vec3 b, uint first, uint count) {
    return FibletLine(a, b, fibletEyePoint(view, a), fibletEyePoint(view, b), first, count);
}

bool isInFrame(FibletView view, vec4 eye) {
    const vec4 at = fibletClip(view, eye);
    return abs(at.x) <= at.w && abs(at.y) <= at.w;
}

// Whether it may be drawn, and the bound on how far it is off, pixels. \param slack  mm that the last point may be from b
bool isWithinBound(FibletLayerParams layer, FibletLine line, float slack, out float error) {
    error = fibletChordError(layer.view, line.eye_a, line.eye_b, float(line.count) * layer.codec.step_mm, distance(line.a, line.b), slack);
    return error <= layer.detail_px && isInFrame(layer.view, line.eye_a) && isInFrame(layer.view, line.eye_b);
}

void noteError(FibletLayerParams layer, float error) {
    if (error > 0.0) atomicMax(CountsBuffer(layer.counts).counts.error_px, floatBitsToUint(error));
}

// What stands for many segments stands for all of them, so none may be left out.
bool showsAll(FibletLayerParams layer, uint fiblet, uint segments) {
    const uint64_t all = (1ul << segments) - 1ul;
    return !kSegments || (WordBuffer(layer.segments).at[fiblet] & all) == all;
}

// A line from a fiblet's start to that of the next. \param start  its own, from the fiblets' origin \return  false: it has to be decoded
bool wholeLine(FibletLayerParams layer, uint fiblet, vec3 start, uint segments, out FibletLine line) {
    const uint next = UintBuffer(layer.next).at[fiblet];
    if (next == FIBLET_NOBODY || !showsAll(layer, fiblet, segments)) return false;
    line = fibletLine(layer.view, start, fibletStart(HeadBuffer(layer.heads).at[next], layer.codec.cell_mm), 0u, segments);
    if (kSmallAsLines && fibletIsSmall(layer.view, line.eye_a, float(segments) * layer.codec.step_mm)) {
        return isInFrame(layer.view, line.eye_a) && isInFrame(layer.view, line.eye_b);
    }
    float error;
    if (!kDetail || !isWithinBound(layer, line, layer.end_slack, error)) return false;
    noteError(layer, error);
    return true;
}
