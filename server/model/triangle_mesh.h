// A surface of triangles as readers deliver it.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace radiata::model {

struct TriangleMesh {
    std::vector<glm::vec3> points;      ///< world mm, RAS, finite
    std::vector<glm::uvec3> triangles;  ///< indices of points, each below their number
    std::string source;                 ///< short name for messages
};

}  // namespace radiata::model
