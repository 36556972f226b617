// Volumes and views that experiments about isosurfaces share; all deterministic.
#pragma once

#include <optional>
#include <string>

#include "model/frame.h"
#include "model/scalar_image.h"

namespace radiata::lab {

/// One isosurface layer, one sample, no annotations, a light from the upper left. \param towards  from the volume to the eye
model::FrameRequest surfaceRequest(const model::ScalarImage& image, const std::string& dataset, std::optional<float> isovalue,
                                   int size, const glm::dvec3& towards);

}  // namespace radiata::lab
