// A scalar volume as a function, in double: values, gradients, and where rays cross its level sets, found in two ways. What
// surfaces of volumes are measured against. Twin of shaders/common/volume.glsl and shaders/isosurface/trace_volume.glsl.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "model/scalar_image.h"

namespace radiata::reference {

/// Samples on a grid; positions are in voxels, (0, 0, 0) is the first sample. Inside a level set is where the value is above.
class ScalarField {
public:
    /// \param values  size.x * size.y * size.z, x fastest
    ScalarField(glm::ivec3 size, std::vector<double> values);
    /// The voxels of an image, whatever its place in the world.
    explicit ScalarField(const model::ScalarImage& image);
    /// Samples a function at the grid's points.
    ScalarField(glm::ivec3 size, const std::function<double(const glm::dvec3&)>& function);

    const glm::ivec3& size() const { return size_; }
    /// Whether the grid's box holds the position; outside it there is nothing.
    bool holds(const glm::dvec3& p) const;
    /// Trilinear; positions outside are clamped to the box.
    double value(const glm::dvec3& p) const;
    /// Of value(), per voxel, in the cell that floor(p) is in (the last one along an axis at its end).
    glm::dvec3 gradient(const glm::dvec3& p) const;
    /// The cubic B-spline with the samples as coefficients, by the recursion of Cox and de Boor, and its gradient per voxel, by
    /// differences of quadratic ones; outside, samples go on by straight lines through the two at the border. Source: Wyman et
    /// al. 2006, Sec. 4.1.1.
    double splineValue(const glm::dvec3& p) const;
    glm::dvec3 splineGradient(const glm::dvec3& p) const;
    /// Points where values are lower. \return unit, or 0 where the smoothed gradient vanishes
    glm::dvec3 outwardNormal(const glm::dvec3& p) const;

    struct Hit {
        double t = 0;
        double margin = 0;  ///< as ChordRoot's, in the cell of the hit
    };
    /// The first t in [t_min, t_max] where value() less `iso` changes sign along origin + t direction within one cell or
    /// between two, by going through the sorted crossings of all grid planes; cells with a corner that is not finite are
    /// outside.
    std::optional<Hit> firstHit(const glm::dvec3& origin, const glm::dvec3& direction, double iso, double t_min,
                                double t_max) const;
    /// The same without cubics. Smallest t in (0, t_max) where origin + t * direction crosses the level set, from either side;
    /// steps of `step` voxels, a parabola through three values where a pair may be missed, bisection to 1e-10 voxels. The box's
    /// sides are no surface. \param direction  unit
    std::optional<double> firstCrossing(const glm::dvec3& origin, const glm::dvec3& direction, double t_max, double iso,
                                        double step = 0.1) const;

private:
    glm::ivec3 size_;
    std::vector<double> values_;
    double sample(int x, int y, int z) const;
    double extended(glm::ivec3 at) const;
    glm::ivec3 cellOf(const glm::dvec3& p) const;
    std::array<double, 8> cornersOf(const glm::ivec3& cell) const;
};

}  // namespace radiata::reference
