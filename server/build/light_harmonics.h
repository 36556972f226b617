// The scene's distant light in spherical harmonics, which texels with transfer are multiplied by.
// Source: Wyman et al. 2006, Eq. 7.
#pragma once

#include <array>
#include <vector>

#include "model/illumination.h"

namespace radiata {

/// Coefficients of red, green and blue radiance, (order)^2 each, full layout, internal convention, world axes; the scene's
/// rotation is applied by the recursion of Ivanic and Ruedenberg. Sky and discs in closed form; a map by its harmonics, or, if
/// it has none, by a sum over its pixels, taken as even patches whose harmonics are those of their centres. \param map  of the
/// environment, or null \throws Error(kInvalidArgument) for lights at a place in the scene, which no distant light can stand
/// for
std::array<std::vector<double>, 3> lightHarmonics(const model::Illumination& light, const model::EnvironmentMap* map,
                                                  int order);

/// A map's radiance in spherical harmonics of order 5, as model::EnvironmentMap keeps them.
std::array<std::vector<double>, 3> environmentHarmonics(const model::EnvironmentMap& map);

/// Rotation matrix of a scene's light. \throws Error(kInvalidArgument) for a quaternion of length 0 or not finite
glm::dmat3 lightRotation(const model::Illumination& light);

/// Direction to the centre of a map's pixel, or any place in it; unit. \param x, y  pixels from the upper left corner
glm::dvec3 environmentDirection(const model::EnvironmentMap& map, double x, double y);

}  // namespace radiata
