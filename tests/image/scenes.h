// Images and requests that the picture tests share: small, generated, the same on every machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "model/frame.h"
#include "model/sh_image.h"

namespace radiata::test {

/// Random glyphs in every voxel of a grid: falling coefficients of both signs about a constant part of 0.6, amplitudes about 1.
model::ShImage randomField(ShLayout layout, const glm::ivec3& size, std::uint32_t seed, const glm::dmat4& voxel_to_world);
/// Turned against the scanner's axes, mirrored, with unequal voxel edges of 1.2, 1 and 1.5 mm.
glm::dmat4 obliqueAffine();
/// The phantom with so many voxels along its longest axis.
model::ShImage phantomImage(int size, int lmax);
/// The same functions at the same places, stored with the first voxel axis reversed.
model::ShImage reversedStorage(const model::ShImage& image);
/// World position of a voxel's centre.
glm::dvec3 voxelCentre(const model::ShImage& image, const glm::ivec3& voxel);

/// One layer, all voxels, amplitudes drawn as so many mm.
model::FrameRequest requestOf(const std::string& dataset, int width, int height, float mm_per_amplitude);
/// A camera that sees all of an image from a direction. \param towards  from the image to the eye, any length
model::Camera cameraAround(const model::ShImage& image, const glm::dvec3& towards, bool perspective);

/// The folder of real images, if RADIATA_DATA names one.
std::optional<std::filesystem::path> dataFolder();

}  // namespace radiata::test
