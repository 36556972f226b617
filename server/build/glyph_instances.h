// Which voxels of an SH image a layer shows, and the glyphs that stand there.
#pragma once

#include <cstdint>
#include <vector>

#include "model/scene.h"
#include "model/sh_image.h"

namespace radiata {

/// Slots (indices into ShImage::voxels) of the voxels that the selection takes, ascending. Axial, coronal and sagittal slices
/// follow the voxel axis nearest to z, y, x of the scanner; the layer of voxels nearest to the position is shown. An oblique
/// slice takes each voxel whose cell the plane cuts, so neighbouring cells leave no gaps; a slab each voxel whose centre is
/// within half its thickness.
std::vector<std::uint32_t> selectVoxels(const model::ShImage& image, const model::VoxelSelection& selection);

/// World position, mm, of the middle of the stored voxels' bounds.
glm::dvec3 datasetCentre(const model::ShImage& image);
/// World bounds, mm, of the stored voxels by their outer faces.
void datasetBounds(const model::ShImage& image, glm::dvec3& minimum, glm::dvec3& maximum);
/// Half the shortest voxel edge, mm: the radius at which a glyph just fills its voxel.
double halfVoxel(const model::ShImage& image);
/// The anatomical plane's unit normal in world space as slices use it (the voxel axis nearest to it).
glm::dvec3 sliceNormal(const model::ShImage& image, const model::VoxelSelection& selection);

}  // namespace radiata
