// Integrals over the part of a distant spherical light that a surface sees, by summing over the cap itself in polar angles
// about its centre. Twin of the sampling in shaders/common/projected_cap.glsl, which knows only the projection's outline.
#pragma once

#include <cstdint>
#include <functional>

#include <glm/glm.hpp>

namespace radiata::reference {

/// Integral of f(direction) times the cosine at the surface, over the directions within `angular_radius` of `light` that are
/// above the horizon. With f = 1 it is the projected solid angle.
/// \param light, normal   unit; \param angular_radius  radians, above 0, at most pi / 2
/// \param cells  per axis of the sum; the error falls with their square, about 1e-4 of the whole at 200
double integrateProjectedCap(const glm::dvec3& light, const glm::dvec3& normal, double angular_radius,
                             const std::function<double(const glm::dvec3&)>& f, int cells = 200);

/// The point of the unit square for one secondary ray; see shaders/common/ray_samples.glsl.
/// \param index  of the ray, counted over all samples of the picture; \param pixel  number of the pixel
glm::dvec2 raySample(std::uint32_t index, std::uint32_t pixel);

}  // namespace radiata::reference
