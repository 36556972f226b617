// Path tracing of isosurfaces' pixels: global light without a lattice. See shaders/isosurface/pixel_paths.comp.
#pragma once

#include <chrono>
#include <optional>

#include "render/frame/pass_run.h"
#include "render/light/path_light.h"
#include "store/store.h"

namespace radiata::render {

/// Light of the layer's pixels. Of a picture that is not settled each gets its first paths, else all that it takes.
void runPixelPaths(PassRun& run, const plan::PassPlan& pass, BandSize& bands);

/// Goes on with the paths of the picture's first sample. \return whether all pixels are as exact as asked for
/// \throws Error(kCancelled); the picture's first sample stays
bool settlePixelPaths(PassRun& run, std::optional<std::chrono::steady_clock::time_point> until, BandSize& bands);

/// Before another sample takes the place of the latest one: adds its paths to those of the picture.
void keepPathCount(gpu::Device& device, Target::Impl& target, const DrawList& list);

/// Pixels of the latest sample, with what all samples of the picture together make of its errors; paths of all samples.
model::IlluminationInfo pathInfo(gpu::Device& device, const Target::Impl& target, const DrawList& list);

/// Gives the layers of a planned frame that are lit by paths from pixels what these need.
void preparePaths(gpu::Device& device, PathLights& lights, store::Store& store, DrawList& list);

}  // namespace radiata::render
