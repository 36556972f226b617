// Global illumination of level sets by plain path tracing in double: the truth for the illumination lattice. Marched
// intersections, pseudo-random directions, no light sampling but of points and, where somebody asks for less noise, of discs:
// nothing that the device's way could share an error with.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "reference/scalar_field.h"

namespace radiata::reference {

/// Light of one colour. Positions in voxels, directions unit; voxels are cubes here.
struct Lights {
    struct Point {
        glm::dvec3 position;
        double intensity = 1;  ///< per steradian
    };
    /// A far disc of even radiance, looked for from every point of a path. One that is a part of the sky is met by chance
    /// instead.
    struct Disc {
        glm::dvec3 direction;   ///< unit
        double cosine = 1;      ///< of its angular radius
        double irradiance = 1;  ///< of a surface that faces it
    };
    std::function<double(const glm::dvec3& direction)> sky;  ///< radiance that comes from a direction; empty: none
    std::vector<Point> points;
    std::vector<Disc> discs{};
};

/// Means over paths and their standard errors.
struct PathMeans {
    std::vector<double> mean, standard_error;
    std::uint64_t buried = 0;  ///< paths that could not leave the surface: counted as dark
};

/// How far from the surface a path starts, voxels along the smoothed normal; Wyman et al. 2006, Sec. 4.1.1.
constexpr double kSurfaceOffset = 0.02;

/// Irradiance of the surface value = iso at p by number of bounces: entry k is E_k, without albedo, of light that met k
/// surfaces before. On one level set of albedo R the irradiance is sum over k of R^k E_k, exactly, as R is constant along a
/// path. \param p  on the surface, voxels \param step  of firstCrossing() Source: Wyman et al. 2006, Eq. 2 and 3. Note: Eq. 3
/// lacks the cosine and the density; with directions of a density proportional to the cosine the estimate is pi times the mean
/// of the radiance.
PathMeans irradianceByBounce(const ScalarField& field, double iso, const glm::dvec3& p, const Lights& lights, int bounces,
                             int paths, std::uint64_t seed, double step = 0.1);

/// Coefficients of the transfer function by number of bounces: orders[k]^2 of bounce k, one after the other, in the full layout
/// of the internal convention, orders 1 to 5; irradiance is sum over k of R^k sum over i of mean[k, i] light[i].
/// Source: Wyman et al. 2006, Eq. 6 and 8. Note: Eq. 4's second term lacks its cosine.
PathMeans transferByBounce(const ScalarField& field, double iso, const glm::dvec3& p, const std::vector<int>& orders, int paths,
                           std::uint64_t seed);

}  // namespace radiata::reference
