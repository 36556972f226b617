// What the catalogue says about one dataset.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "math/sh_convention.h"
#include "math/sh_layout.h"

namespace radiata::model {

/// What a dataset holds. Scalar volumes have size, place and the range of their values, tractograms and meshes counts and
/// bounds, environment maps their pixels as size and the range of their luminance; the rest is about glyphs.
enum class DatasetKind { kShImage, kScalarVolume, kTractogram, kEnvironmentMap, kMesh };

/// What a tractogram has on the device.
struct FibreMemory {
    std::uint64_t device_bytes = 0;
    std::uint64_t pages = 0, resident_pages = 0;
};

struct FibreGroupSize {
    std::string name;
    std::uint64_t fibres = 0;
};

struct DatasetInfo {
    std::string id;  ///< [a-z0-9_-], 1 to 64 characters
    DatasetKind kind = DatasetKind::kShImage;
    glm::ivec3 size{0};
    glm::dmat4 voxel_to_world{1.0};
    ShLayout layout;
    ShConvention convention = ShConvention::kTournier07;  ///< of the file
    ShAxes axes = ShAxes::kWorld;
    int tensor_order = 0;       ///< 2 to 12: the file held tensors, the layout has their bands; 0: it held spherical harmonics
    std::string tensor_format;  ///< how a tensor file was read: "mrtrix", "voigt-stiffness", ...
    std::uint64_t glyph_count = 0;
    std::uint64_t rejected_voxels = 0;  ///< a coefficient is not finite; of scalar volumes: NaN, infinite or beyond 3e38
    float amplitude_max = 0;
    float amplitude_typical = 0;  ///< three quarters of the glyphs stay below it; what global scaling divides by
    std::uint64_t gpu_bytes = 0;
    std::vector<FibreGroupSize> fibre_groups;                ///< of a tractogram that was read
    std::vector<std::string> fibre_columns, vertex_columns;  ///< names
    double error_mean_um = 0, error_max_um = 0;              ///< of drawn points against those that were encoded
    double step_mm = 0;                                      ///< between points of tractograms
    double set_anew_mean_um = 0, set_anew_max_um = 0;        ///< of the file's points against lines whose points were set anew
    std::uint64_t fibres = 0, points = 0;                    ///< of a tractogram; points of a mesh too
    std::string remarks;  ///< of a tractogram that was read: what was assumed and left out, as sentences
    std::uint64_t fiblet_pages = 0, resident_pages = 0;  ///< of a tractogram that was drawn: all, and those on the device
    std::uint64_t triangles = 0;                         ///< of a mesh
    float value_min = 0, value_max = 0;                  ///< of a scalar volume's finite values
    glm::dvec3 bounds_min{0}, bounds_max{0};             ///< world mm, outer faces of the voxels with glyphs; points of fibres
};

}  // namespace radiata::model
