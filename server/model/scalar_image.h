// One number per voxel, to colour glyphs by.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace radiata::model {

struct ScalarImage {
    glm::ivec3 size{0};              ///< voxels along i, j, k
    glm::dmat4 voxel_to_world{1.0};  ///< voxel centres have whole indices; world mm, RAS
    std::vector<float> values;       ///< i fastest, then j, then k; may hold NaN and infinities
    std::string source;              ///< short name for messages

    float at(const glm::ivec3& v) const {
        const auto i = static_cast<std::size_t>(v.x), j = static_cast<std::size_t>(v.y), k = static_cast<std::size_t>(v.z);
        return values[i + static_cast<std::size_t>(size.x) * (j + static_cast<std::size_t>(size.y) * k)];
    }
};

}  // namespace radiata::model
