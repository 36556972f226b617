// The lines of a fiblet for the device's rasteriser, by a walk along it: one for each segment, or fewer (line_detail.glsl). Whoever
// includes this says what becomes of each:
//   bool takeLine(FibletView view, uint fiblet, FibletLine line);  // false: no more are wanted
// To be included after walk.glsl and line_end.glsl.
#include "shaders/fiblet/line_detail.glsl"

bool takeLine(FibletView view, uint fiblet, FibletLine line);

// Segments [first, end), line by line. \return  whether more are wanted
bool takeSegments(FibletLayerParams layer, inout FibletWalk walk, uint fiblet, uint first, uint end) {
    vec3 here = walk.pen.point;
    vec4 eye = fibletEyePoint(layer.view, here);
    for (uint segment = first; segment < end; ++segment) {
        stepWalk(layer, walk, segment);
        const vec4 next = fibletEyePoint(layer.view, walk.pen.point);
        if (!takeLine(layer.view, fiblet, FibletLine(here, walk.pen.point, eye, next, segment, 1u))) return false;
        here = walk.pen.point;
        eye = next;
    }
    return true;
}

// Groups of segments as one line each where that is within the bound.
void takeGroups(FibletLayerParams layer, FibletWalk walk, uint fiblet) {
    float worst = 0.0;
    bool more = true;
    for (uint first = 0u; first < walk.segments && more; first += layer.detail_segments) {
        const uint end = min(first + layer.detail_segments, walk.segments);
        FibletWalk ahead = walk;
        for (uint segment = first; segment < end; ++segment) stepWalk(layer, ahead, segment);
        const FibletLine line = fibletLine(layer.view, walk.pen.point, ahead.pen.point, first, end - first);
        float error;
        if (line.count > 1u && isWithinBound(layer, line, 0.0, error)) {
            worst = max(worst, error);
            more = takeLine(layer.view, fiblet, line);
            walk = ahead;
        } else {
            more = takeSegments(layer, walk, fiblet, first, end);
        }
    }
    noteError(layer, worst);
}

void takeLines(FibletLayerParams layer, FibletWalk walk, uint fiblet) {
    if (kFewerLines) {
        FibletLine line;
        if (wholeLine(layer, fiblet, walk.pen.point, walk.segments, line)) {
            takeLine(layer.view, fiblet, line);
            return;
        }
    }
    if (kDetail && showsAll(layer, fiblet, walk.segments)) {
        takeGroups(layer, walk, fiblet);
    } else {
        takeSegments(layer, walk, fiblet, 0u, walk.segments);
    }
}
