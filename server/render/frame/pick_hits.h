// All hits of a pick's ray with the glyph that it meets first, by the picture's method of intersection.
#pragma once

#include <functional>

#include "model/pick.h"
#include "render/frame/drawer.h"

namespace radiata::render {

/// The ray of a pixel in world space, in double, as the device has it.
struct PickRay {
    glm::dvec3 origin_mm{0};
    glm::dvec3 direction{0};   ///< unit
    double near = 0, far = 0;  ///< first and last parameter that is seen, mm
    glm::dvec3 at(double t) const { return origin_mm + t * direction; }
};

/// \param away  pixels from the middle of the list's window
PickRay pickRay(const DrawList& list, const glm::ivec2& away = glm::ivec2(0));

/// Adds to what is known about the glyph under a pixel. \param instance  the glyph on the device
using FoundGlyph = std::function<void(const shader::GlyphInstance& instance, model::PickedGlyph& glyph)>;

/// Fills PickedGlyph::hits; the arguments must outlive it. It throws Error(kInvalidArgument) for ellipsoids,
/// Error(kUnsupported) if the method does not draw the layer's bands. \param quality  of the picture: method and its settings
FoundGlyph allHitsFinder(gpu::Device& device, Drawer& drawer, const DrawList& list, const model::Quality& quality,
                         const plan::Abilities& abilities);

}  // namespace radiata::render
