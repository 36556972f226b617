// First hit of a ray with a capsule, by marching along the distance from its axis. Twin of shaders/common/capsule.glsl.
#pragma once

#include <glm/glm.hpp>

namespace radiata::reference {

struct CapsuleHit {
    bool hit = false;
    bool sure = true;      ///< false: the ray passes within 1e-4 radii of a tangent
    double t = 0;          ///< in units of the direction's length, from the origin; within 1e-10 of the ray's length to it
    glm::dvec3 normal{0};  ///< unit, outwards
};

/// \param start, along  one end of the axis and the way to the other, which may be zero
/// \param nearest       least parameter; a ray that begins inside hits nothing
CapsuleHit capsuleHit(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& start, const glm::dvec3& along,
                      double radius, double nearest);

}  // namespace radiata::reference
