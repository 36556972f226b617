// Frames of one view by several methods: GPU time from interleaved runs, and the lossless outputs of each.
#pragma once

#include <string>
#include <vector>

#include "model/frame.h"
#include "render/frame/renderer.h"
#include "tools/lab/report.h"

namespace radiata::lab {

struct Candidate {
    std::string name, family;
    model::FrameRequest request;
};

struct Measured {
    std::string name, family;
    Series time;                       ///< GPU ms of the glyph passes, or of `passes`
    Series frame_time;                 ///< GPU ms of all passes
    model::FrameInfo info;             ///< of the last frame
    std::vector<float> depth, normal;  ///< as FramePixels has them
};

/// Each candidate is drawn once to warm up and for its outputs, then `repeats` times in turn with the others.
/// \param passes  beginnings of the names of the passes that count as its time
/// \throws Error of the renderer, for a candidate that cannot be drawn
std::vector<Measured> measure(render::Renderer& renderer, const std::vector<Candidate>& candidates, int repeats,
                              const std::vector<std::string>& passes = {"glyph"});

/// Sum of the passes whose names begin so; all of them for an empty list.
double passTime(const model::FrameInfo& info, const std::vector<std::string>& beginnings);

}  // namespace radiata::lab
