// What is shown of a tractogram, and how. Mirrors proto/radiata/v1/tractogram.proto with every choice filled in.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "math/colour_map.h"

namespace radiata::model {

/// Numbers as in shaders/shared/layer_look.glsl.
enum class FibreColourMode { kDirection, kUniform, kFibre, kGroup, kColumn, kLength, kPointColumn, kDistance, kEnds };

struct FibreColourRange {
    float low = 0;
    float high = 1;
    bool operator==(const FibreColourRange&) const = default;
};

/// Where the base colour of a fibre comes from.
struct FibreColour {
    FibreColourMode mode = FibreColourMode::kDirection;
    ColourMap map = ColourMap::kViridis;    ///< where usesMap()
    std::optional<FibreColourRange> range;  ///< of the map: values of the column, or mm; none: those of the whole tractogram
    std::string column;                     ///< kColumn: a column of values per fibre; kPointColumn: per point
    int component = 0;                      ///< kPointColumn: of a column of vectors
    std::string region;                     ///< kDistance: one region as in selection_text.h
    glm::vec3 uniform{0.5F};                ///< kUniform: linear RGB
    bool usesMap() const {
        return mode == FibreColourMode::kColumn || mode == FibreColourMode::kLength || mode == FibreColourMode::kPointColumn ||
               mode == FibreColourMode::kDistance;
    }
    bool operator==(const FibreColour&) const = default;
};

/// The half space {p : dot(p - point, normal) <= 0} is shown.
struct FibreCut {
    glm::dvec3 point_mm{0};      ///< world
    glm::dvec3 normal{0, 0, 1};  ///< world axes; any length but zero
    bool operator==(const FibreCut&) const = default;
};

/// Shows the segments whose middle lies in a region, or those whose middle does not.
struct FibreRegionCut {
    std::string region;  ///< one region as in selection_text.h
    bool outside = false;
    bool by_depths = false;  ///< of a mesh: pixel by pixel between its nearest front and farthest back face
    bool operator==(const FibreRegionCut&) const = default;
};

/// Shows what has values within bounds, ends included: fibres by a column per fibre, segments by the mean of their two points.
struct FibreCriterion {
    std::string column;
    float low = 0, high = 0;  ///< may be infinite
    bool operator==(const FibreCriterion&) const = default;
};

/// A set of fibres: those that pass every condition.
struct FibreSet {
    std::vector<std::string> groups;  ///< in any of them; empty: no condition
    std::optional<float> length_min_mm, length_max_mm;
    std::vector<std::uint32_t> fibres;  ///< by number; empty: no condition
    std::string selection;              ///< as in selection_text.h; empty: no condition
    bool isAll() const { return *this == FibreSet{}; }
    bool operator==(const FibreSet&) const = default;
};

/// What becomes of fibres that are not selected while some are.
enum class UnselectedFibres { kDimmed, kHidden };

/// Streamlines of a tractogram.
struct TractogramLayer {
    std::string dataset_id;
    FibreColour colour;
    int line_width_px = 1;
    std::optional<float> tube_radius_mm;  ///< capsules; none: lines
    std::optional<float> occlusion_px;    ///< radius of ambient occlusion in screen space; none: there is none
    std::optional<float> halo_px;         ///< width of dark borders around nearer fibres
    bool exact_width = false;             ///< lines are line_width_px wide across, not along a row or column of pixels
    std::vector<FibreCut> cuts;
    std::vector<FibreRegionCut> region_cuts;
    std::vector<FibreCriterion> criteria;
    FibreSet shown;                    ///< the others are left out
    std::optional<FibreSet> selected;  ///< stand out of those shown: with tube_radius_mm, these alone are tubes
    UnselectedFibres unselected = UnselectedFibres::kDimmed;
    bool operator==(const TractogramLayer&) const = default;
};

/// How fiblets are drawn.
enum class FibletPipeline { kAuto, kAtomic, kPull, kMesh, kMeshSerial, kGeometry, kTessellation, kLines, kPoints };
/// "atomic", "mesh-serial", ...; "auto"
std::string_view pipelineName(FibletPipeline pipeline);
/// Of uncompressed points, all of which are drawn.
inline bool drawsUncompressed(FibletPipeline pipeline) {
    return pipeline == FibletPipeline::kLines || pipeline == FibletPipeline::kPoints;
}
/// By the device's own rasteriser.
inline bool drawsByRasteriser(FibletPipeline pipeline) {
    return pipeline != FibletPipeline::kAuto && pipeline != FibletPipeline::kAtomic && pipeline != FibletPipeline::kPoints;
}
/// Which of them are. kAuto: two phases where that pays, else the frustum.
enum class FibletCulling { kAuto, kTwoPhase, kFrustum, kNone, kCoverage };

constexpr int kLineWidthMax = 31;
constexpr std::size_t kFibreCutsMax = 6;
constexpr std::size_t kFibreFiltersMax = 16;  ///< region cuts, and criteria
constexpr float kTubeRadiusMaxMm = 100;
constexpr float kFibreOcclusionMaxPx = 128;
constexpr float kHaloMaxPx = 8;
constexpr float kDetailMinPx = 0.05F, kDetailMaxPx = 16;

}  // namespace radiata::model
