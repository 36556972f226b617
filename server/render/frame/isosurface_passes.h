// The passes of isosurface layers: first hits of opaque ones, all crossings of transparent ones, and rays that they block.
#pragma once

#include "render/frame/pass_run.h"

namespace radiata::render {

/// Fills shader::IsosurfaceParams of the layers that are isosurfaces, and makes room for the veil, if the plan has either.
void fillIsosurfaceParameters(gpu::Device& device, Target::Impl& target, const DrawList& list);

/// Grid coordinates of the frame's reference point, as a whole cell and the rest.
void placeInGrid(const store::VolumeDataset& volume, const glm::dvec3& reference_mm, glm::ivec3& base, glm::vec3& fraction);

/// An empty surface buffer.
void runClear(PassRun& run, const plan::PassPlan& pass);

/// First hits of one layer into the surface buffer.
void runIsosurfaceTrace(PassRun& run, const plan::PassPlan& pass, BandSize& bands);

/// All transparent layers, nearest first, over the surface buffer.
void runIsosurfaceVeil(PassRun& run, const plan::PassPlan& pass, BandSize& bands);

/// What shaders/isosurface/layer.glsl is specialised by.
std::vector<std::uint32_t> isosurfaceConstants(const model::IsosurfaceSettings& settings);

/// Address of a layer's shader::IsosurfaceParams.
std::uint64_t isosurfaceAddress(const Target::Impl& target, std::size_t layer);

/// The nearest crossings that are not composed yet into the peel surface (shaders/isosurface/peel.comp).
/// \param surfaces  bit i: layer i is a transparent isosurface \param peel  address of shader::PeelParams
void runIsosurfacePeel(PassRun& run, std::uint32_t surfaces, std::uint64_t peel, bool counting, BandSize& bands);

}  // namespace radiata::render
