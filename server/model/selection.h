// Which fibres of a tractogram are meant: regions and filters joined by and, or, not.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

namespace radiata::model {

enum class RegionShape {
    kEllipsoid,  ///< |inverse(axes) (p - centre)| <= 1; spheres too
    kBox,        ///< low <= p <= high
    kHalfSpace,  ///< dot(p - point, normal) <= 0
    kMask,       ///< the voxel that holds p has a value above the threshold
    kMesh,       ///< inside of a closed surface of triangles
};

/// A part of space, world mm, RAS.
struct FibreRegion {
    RegionShape shape = RegionShape::kEllipsoid;
    glm::dvec3 centre{0};  ///< of an ellipsoid; low corner of a box; point of a half space
    glm::dmat3 axes{1.0};  ///< of an ellipsoid: columns are its three half axes, in any directions that span space
    glm::dvec3 high{0};    ///< high corner of a box; normal of a half space, of any length but 0
    std::string dataset;   ///< of a mask: catalogue id of a scalar volume; of a mesh: of a surface
    double threshold = 0.5;
    bool operator==(const FibreRegion&) const = default;
};

/// How much of a fibre's line (its segments, not its points alone) must lie in a region.
enum class RegionMode { kAny, kAll, kEitherEnd, kBothEnds };

/// What of a column with a value per vertex is compared: fibres have one number then.
enum class ColumnPart { kMean, kLeast, kLargest };

struct Selection {
    enum class Kind {
        kEverything,
        kRegion,   ///< regions[0] by mode
        kOrdered,  ///< the fibre meets regions[0], then regions[1], ..., counted from one end or the other
        kLength,   ///< low <= length <= high, mm
        kColumn,   ///< low <= value <= high of the column `name`, its first component; part for columns per vertex
        kGroup,    ///< the group `name`
        kFibres,   ///< numbers within ranges, ends included
        kShare,    ///< each fibre with probability `amount`, by the seed
        kSample,   ///< as many fibres as `amount` says, of all, by the seed
        kAnd,
        kOr,
        kNot,
    };
    Kind kind = Kind::kEverything;
    RegionMode mode = RegionMode::kAny;
    std::vector<FibreRegion> regions;
    std::string name;
    ColumnPart part = ColumnPart::kMean;
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    double amount = 1;
    std::uint64_t seed = 1;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ranges;
    std::vector<Selection> children;  ///< kAnd, kOr: two or more; kNot: one
    bool operator==(const Selection&) const = default;
};

/// The answer to a selection.
struct SelectedFibres {
    std::uint64_t total = 0;            ///< fibres of the tractogram
    std::vector<std::uint32_t> fibres;  ///< ascending
};

constexpr std::size_t kSelectionTextMax = 65536;  ///< bytes
constexpr int kSelectionDepthMax = 64;

}  // namespace radiata::model
