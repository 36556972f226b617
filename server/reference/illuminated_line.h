// Light reflected by a thin line, by searching the normals of a thin cylinder. Twin of shaders/common/illuminated_line.glsl.
#pragma once

#include <glm/glm.hpp>

namespace radiata::reference {

/// Diffuse and specular part, each with the largest value that its cosines n.l and n.h take over normals orthogonal to the
/// tangent (Zoeckler et al. 1996), of glTF's dielectric. The normals are searched, not solved for: off by less than 1e-9.
/// \param base  linear RGB; \param roughness  above 0 up to 1; \param tangent, viewer, light  unit
glm::dvec3 illuminatedLine(const glm::dvec3& base, double roughness, const glm::dvec3& tangent, const glm::dvec3& viewer,
                           const glm::dvec3& light);

}  // namespace radiata::reference
