#include "store/scalar_dataset.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/error.h"
#include "build/volume_bricks.h"

namespace radiata::store {
namespace {

constexpr double kGridTolerance = 0.01;  // voxels

glm::ivec3 sorted(glm::ivec3 size) {
    std::sort(&size.x, &size.x + 3);
    return size;
}

std::string sizeText(const glm::ivec3& size) {
    return std::to_string(size.x) + " x " + std::to_string(size.y) + " x " + std::to_string(size.z);
}

}  // namespace

ScalarDataset::ScalarDataset(const std::string& id, model::ScalarImage image) : image_(std::move(image)) {
    info_.id = id;
    info_.kind = model::DatasetKind::kScalarVolume;
    info_.size = image_.size;
    info_.voxel_to_world = image_.voxel_to_world;
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (const float value : image_.values) {
        if (!hasValue(value)) {
            ++info_.rejected_voxels;
            continue;
        }
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (low <= high) {
        info_.value_min = low;
        info_.value_max = high;
    }
    info_.bounds_min = glm::dvec3(std::numeric_limits<double>::infinity());
    info_.bounds_max = -info_.bounds_min;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 voxel =
            glm::dvec3(corner & 1 ? info_.size.x : 0, corner & 2 ? info_.size.y : 0, corner & 4 ? info_.size.z : 0) - 0.5;
        const glm::dvec3 world(info_.voxel_to_world * glm::dvec4(voxel, 1.0));
        info_.bounds_min = glm::min(info_.bounds_min, world);
        info_.bounds_max = glm::max(info_.bounds_max, world);
    }
}

glm::dmat4 voxelMap(const ScalarDataset& scalars, const model::DatasetInfo& glyphs) {
    const model::DatasetInfo& info = scalars.info();
    const std::string both = "colour image '" + info.id + "' and glyphs '" + glyphs.id + "'";
    const glm::dmat4 map = glm::inverse(info.voxel_to_world) * glyphs.voxel_to_world;
    // The axis of the volume that each axis of the glyphs' image runs along, forwards or backwards.
    glm::ivec3 size(0);
    for (int axis = 0; axis < 3; ++axis) {
        for (int other = 0; other < 3; ++other) {
            if (std::lround(std::abs(map[axis][other])) == 1) size[other] = glyphs.size[axis];
        }
    }
    double apart = 0;  // voxels; the map is affine, so the distance to whole indices is largest in a corner
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 voxel(corner & 1 ? glyphs.size.x - 1 : 0, corner & 2 ? glyphs.size.y - 1 : 0,
                               corner & 4 ? glyphs.size.z - 1 : 0, 1);
        const glm::dvec3 there(map * voxel);
        const glm::dvec3 nearest = glm::clamp(glm::round(there), glm::dvec3(0), glm::dvec3(info.size - 1));
        apart = std::max(apart, glm::length(there - nearest));
    }
    const glm::ivec3 sorted_glyphs = sorted(glyphs.size), sorted_scalars = sorted(info.size);
    if (sorted_glyphs != sorted_scalars) {
        throw Error(Code::kInvalidArgument, both + " have different sizes: " + sizeText(info.size) + " and " +
                                                sizeText(glyphs.size) + " voxels; regrid the colour image to the glyphs' grid");
    }
    if (!(apart <= kGridTolerance) || size != info.size) {
        char text[32];
        std::snprintf(text, sizeof text, "%.3g", apart);
        throw Error(Code::kInvalidArgument, both + " lie at different places: voxels of one are up to " + text +
                                                " voxels away from those of the other; regrid the colour image to the "
                                                "glyphs' grid");
    }
    return map;
}

}  // namespace radiata::store
