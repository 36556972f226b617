// One scalar volume. It stays in host memory: the device gets the values of the glyphs that a layer shows, no more.
#pragma once

#include <string>

#include "model/dataset.h"
#include "model/scalar_image.h"

namespace radiata::store {

/// Immutable.
class ScalarDataset {
public:
    ScalarDataset(const std::string& id, model::ScalarImage image);

    const model::DatasetInfo& info() const { return info_; }
    const model::ScalarImage& image() const { return image_; }

private:
    model::ScalarImage image_;
    model::DatasetInfo info_;
};

/// The map from voxel indices of the glyphs' image to those of the volume: whole numbers, but for rounding. Files may store the
/// same grid with axes in another order or direction, as programs that read each other's files do.
/// \throws Error(kInvalidArgument) with both sizes, or the largest distance, unless every voxel of one lies within a hundredth
///         of a voxel of a voxel of the other
glm::dmat4 voxelMap(const ScalarDataset& scalars, const model::DatasetInfo& glyphs);

}  // namespace radiata::store
