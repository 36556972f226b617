// A brain-like test image of any size, made from a seed: bundles of fibres with known courses, ids and crossings.
// The fibre orientation density of a voxel is that of its centre: one lobe per bundle there (phantom_lobe.h), weighted by the
// bundle's volume fraction, a small isotropic part for grey matter and fluid, and weak radial lobes in the cortex.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "build/phantom_bundles.h"
#include "build/phantom_field.h"
#include "model/sh_image.h"

namespace radiata {

struct PhantomOptions {
    std::uint64_t seed = 1;
    int size = 96;                   ///< voxels along the longest axis (front to back), 1 to 1024
    std::optional<double> voxel_mm;  ///< instead of `size`: edge of the cubic voxels, 0.1 to 200
    std::uint64_t slice_glyphs = 0;  ///< instead of both: one axial slice with at least so many glyphs, to 1,000,000
    int lmax = 8;                    ///< even, 0 to 16
    double noise = 0;                ///< standard deviation added to each coefficient, 0 to 1; lobes peak near 1 at lmax 8
    std::uint64_t bytes_max = 4ULL << 30;  ///< of coefficients, counted for all voxels of the grid
};

/// Geometry of the image; nothing is allocated yet.
struct PhantomGrid {
    glm::ivec3 size{0};
    glm::dmat4 voxel_to_world{1.0};
    glm::dvec3 voxelCentre(const glm::ivec3& voxel) const {
        return glm::dvec3(voxel_to_world * glm::dvec4(glm::dvec3(voxel), 1.0));
    }
};

/// Immutable after construction. Everything is the same for the same options on any number of threads.
class Phantom {
public:
    /// \throws Error(kInvalidArgument) naming an option out of range, Error(kResourceExhausted) if the coefficients would take
    ///         more than bytes_max
    explicit Phantom(const PhantomOptions& options);

    const PhantomOptions& options() const { return options_; }
    const PhantomGrid& grid() const { return grid_; }
    const phantom::BundleField& field() const { return field_; }

    /// Internal convention, world axes, even bands.
    model::ShImage shImage() const;
    /// Id of the strongest bundle that fills at least a tenth of the voxel, else 0; i fastest, then j, k.
    std::vector<std::uint8_t> labels() const;

private:
    PhantomOptions options_;
    PhantomGrid grid_;
    phantom::BundleField field_;
};

/// Phantom(options).shImage()
model::ShImage phantomShImage(const PhantomOptions& options);

}  // namespace radiata
