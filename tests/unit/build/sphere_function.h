// A spherical-harmonics function for the tests of this folder: evaluated in double with unnormalised Legendre functions and
// maximised by pattern search, so by another way than the code under test.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "math/sh_layout.h"

namespace radiata::testing {

/// All basis functions at a unit direction, internal convention.
std::vector<double> basisAt(ShLayout layout, const glm::dvec3& d);

/// `count` nearly even directions on the sphere (Fibonacci).
std::vector<glm::dvec3> fibonacciDirections(std::size_t count);

/// The largest value of `f` found near `start` by steps on the sphere that shrink from `step` to 1e-7 rad.
double climb(const std::function<double(const glm::dvec3&)>& f, const glm::dvec3& start, double step,
             glm::dvec3* where = nullptr);

/// True extents of a glyph to about 1e-12: radius, then the extents along +x +y +z -x -y -z, of the visible surface.
struct TrueExtents {
    double radius = 0;
    double along[6] = {};
    double amplitude_max = 0;      ///< max |f|
    double signed_extent[3] = {};  ///< max |d_a f|, visible or not
};
class Maximiser {
public:
    Maximiser(ShLayout layout, std::size_t samples);
    TrueExtents extents(std::span<const float> coefficients, bool negative_lobes) const;

private:
    ShLayout layout_;
    std::vector<glm::dvec3> directions_;
    std::vector<double> basis_;  // direction by direction
};

}  // namespace radiata::testing
