// A trilinear scalar field in double, its level sets found by marching, and its gradient smoothed by a cubic B-spline: what
// surfaces of volumes are measured against. Nothing is shared with shaders/common/cubic.glsl; this way knows nothing of cubics.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

namespace radiata::reference {

/// Samples on a grid; positions are in voxels, (0, 0, 0) is the first sample. Inside a level set is where the value is above.
class ScalarField {
public:
    /// \param values  size.x * size.y * size.z, x fastest
    ScalarField(glm::ivec3 size, std::vector<double> values);
    /// Samples a function at the grid's points.
    ScalarField(glm::ivec3 size, const std::function<double(const glm::dvec3&)>& function);

    const glm::ivec3& size() const { return size_; }
    /// Whether the grid's box holds the position; outside it there is nothing.
    bool holds(const glm::dvec3& p) const;
    /// Trilinear; positions outside are clamped to the box.
    double value(const glm::dvec3& p) const;
    /// Gradient of the cubic B-spline with the samples as coefficients, per voxel; samples outside repeat the border's.
    /// Source: Wyman et al. 2006, Sec. 4.1.1.
    glm::dvec3 smoothGradient(const glm::dvec3& p) const;
    /// Points where values are lower. \return unit, or 0 where the smoothed gradient vanishes
    glm::dvec3 outwardNormal(const glm::dvec3& p) const;

    /// Smallest t in (0, t_max) where origin + t * direction crosses the level set, from either side; steps of `step` voxels, a
    /// parabola through three values where a pair may be missed, bisection to 1e-10 voxels. The box's sides are no surface.
    /// \param direction  unit
    std::optional<double> firstCrossing(const glm::dvec3& origin, const glm::dvec3& direction, double t_max, double iso,
                                        double step = 0.1) const;

private:
    glm::ivec3 size_;
    std::vector<double> values_;
    double sample(int x, int y, int z) const;
};

}  // namespace radiata::reference
