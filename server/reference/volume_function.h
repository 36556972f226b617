// A scalar volume as a function, in double: values, gradients, and the first hit of a ray with an isosurface by going through
// the sorted crossings of all grid planes. Twin of shaders/isosurface/{volume,trace_volume}.glsl.
#pragma once

#include <optional>

#include <glm/glm.hpp>

#include "model/scalar_image.h"

namespace radiata::reference {

/// Grid coordinates: sample (i, j, k) lies at (i, j, k). The image must outlive it.
class VolumeFunction {
public:
    explicit VolumeFunction(const model::ScalarImage& image) : image_(image) {}

    /// Trilinear. \param p  in [0, size - 1]^3
    double value(const glm::dvec3& p) const;
    /// Of value(), per grid unit, in the cell that floor(p) is in (the last one along an axis at its end).
    glm::dvec3 gradient(const glm::dvec3& p) const;
    /// Of the cubic B-spline with the samples as coefficients; samples beyond the volume are those of its faces.
    glm::dvec3 splineGradient(const glm::dvec3& p) const;
    /// Value of that spline.
    double splineValue(const glm::dvec3& p) const;

    struct Hit {
        double t = 0;
        double margin = 0;  ///< as ChordRoot's, in the cell of the hit
    };
    /// The first t in [t_min, t_max] where value() less `isovalue` changes sign along origin + t direction within one cell or
    /// between two; cells with a corner that is not finite are outside.
    std::optional<Hit> firstHit(const glm::dvec3& origin, const glm::dvec3& direction, double isovalue, double t_min,
                                double t_max) const;

private:
    glm::ivec3 cellOf(const glm::dvec3& p) const;
    double sample(int i, int j, int k) const;

    const model::ScalarImage& image_;
};

}  // namespace radiata::reference
