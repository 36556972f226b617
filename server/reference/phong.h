// Lambert's and Phong's reflection and ambient light that varies with the normal, in double, by angles instead of products of
// vectors. Twin of shaders/common/phong.glsl. Sources: Phong 1975; Wyman et al. 2006, Sec. 5.
#pragma once

#include <glm/glm.hpp>

namespace radiata::reference {

/// Radiance by an irradiance of 1 on a surface that faces the light. \param normal, light  unit, away from the surface
glm::dvec3 lambertReflection(const glm::dvec3& base, const glm::dvec3& normal, const glm::dvec3& light);
/// The same with a highlight of exponent 30 that takes 4 % of the light. \param viewer  unit, away from the surface
glm::dvec3 phongReflection(const glm::dvec3& base, const glm::dvec3& normal, const glm::dvec3& viewer, const glm::dvec3& light);
/// Factor on the ambient light, 0 to 2.
double varyingAmbient(const glm::dvec3& normal, const glm::dvec3& light);

}  // namespace radiata::reference
