// Pictures of globally lit isosurfaces and how far they are from the truth: path tracing in double at some of their pixels.
#pragma once

#include <string>
#include <vector>

#include "model/frame.h"
#include "model/scalar_image.h"
#include "render/frame/renderer.h"

namespace radiata::lab {

/// Skies that experiments share: even, and with suns of 18 and 5 degrees.
enum class LabSky { kEven, kWideSun, kSun };
std::string name(LabSky sky);

/// A white-lit surface of albedo 0.7 under one of them, three bounces, one sample per pixel through its centre, as texels want
/// it at rest. \param image  1 mm voxels along the world's axes
model::FrameRequest litRequest(const model::ScalarImage& image, const std::string& dataset, float isovalue, LabSky sky,
                               int size);

/// Radiance at some pixels, with its standard error.
struct LightTruth {
    std::vector<std::size_t> pixels;
    std::vector<double> radiance, standard_error;
    double mean = 0;
};

/// \param count, paths  pixels, chosen evenly among those that show the surface, and paths at each
LightTruth lightTruth(render::Renderer& renderer, const model::ScalarImage& image, const model::FrameRequest& request,
                      int count, int paths);

/// Root mean square of the picture's differences to the truth at its pixels, less what is the truth's own error, relative to
/// the truth's mean. Pictures have 8 bits: 0.2 % of it is rounding.
double lightError(const model::Frame& frame, const LightTruth& truth);

}  // namespace radiata::lab
