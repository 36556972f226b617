// Regions as they are asked about boxes, points and segments; world mm.
#pragma once

#include <functional>
#include <memory>

#include "model/scalar_image.h"
#include "model/selection.h"
#include "model/triangle_mesh.h"

namespace radiata {

enum class BoxRelation { kOutside, kInside, kUnknown };

/// Immutable. The region is closed: its surface belongs to it, up to rounding.
class RegionVolume {
public:
    virtual ~RegionVolume() = default;
    /// kOutside and kInside are certain for all of the box, surface included.
    virtual BoxRelation relate(const glm::dvec3& low, const glm::dvec3& high) const = 0;
    virtual bool contains(const glm::dvec3& p) const = 0;
    /// Whether any point of the segment is inside.
    virtual bool meets(const glm::dvec3& a, const glm::dvec3& b) const = 0;
    /// Whether all of the segment is inside.
    virtual bool holds(const glm::dvec3& a, const glm::dvec3& b) const = 0;
};

/// The volume of a mask by its catalogue id. \throws Error(kNotFound, kInvalidArgument)
using MaskLookup = std::function<std::shared_ptr<const model::ScalarImage>(const std::string& dataset)>;

/// The surface of a mesh by its catalogue id. \throws Error(kNotFound, kInvalidArgument)
using MeshLookup = std::function<std::shared_ptr<const model::TriangleMesh>(const std::string& dataset)>;

/// \throws as masks() and meshes(), Error(kInvalidArgument) for a mesh that is open
std::unique_ptr<RegionVolume> regionVolume(const model::FibreRegion& region, const MaskLookup& masks, const MeshLookup& meshes);

/// Voxels with a value above the threshold, each with all the space that is nearest to its centre along the voxel axes.
std::unique_ptr<RegionVolume> maskVolume(const model::ScalarImage& image, double threshold);

}  // namespace radiata
