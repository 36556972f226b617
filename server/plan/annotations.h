// What is written on a picture so that people cannot misread it: which way the patient lies, how finished the picture is,
// what of the data it leaves out.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/annotation.h"
#include "model/frame.h"

namespace radiata::plan {

/// What the picture leaves out of the datasets.
struct SubsetFacts {
    std::uint64_t glyphs = 0;                ///< in the scene
    std::uint64_t glyphs_available = 0;      ///< that the layers' datasets hold
    std::vector<model::LeftOut> left_out{};  ///< of layers
};

/// Orientation letters of a world direction (RAS): the dominant axis first, a second letter where the direction leaves that
/// axis by more than about 14 degrees ("LA"). \param direction  unit, world
std::string orientationLetters(const glm::dvec3& direction);

/// All marks of a picture, the most important first; none if the scene's annotations are hidden.
/// \param samples  per pixel in this picture
/// \throws Error(kInvalidArgument) for a camera that cameraFrame() refuses
std::vector<model::Mark> annotations(const model::FrameRequest& request, model::FrameState state, int samples,
                                     const SubsetFacts& facts);

/// One legend for each different colour map, range and quantity of the layers, in their order; none if the annotations are
/// hidden. \param request  with every choice filled in, as a frame echoes it
std::vector<model::ColourBar> colourBars(const model::FrameRequest& request);

}  // namespace radiata::plan
