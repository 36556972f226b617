#include "build/folded_ball.h"

#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "base/parallel.h"

namespace radiata {

model::ScalarImage foldedBall(int size) {
    if (size < 2 || size > 2048) {
        throw Error(Code::kInvalidArgument, "the folded ball's size is " + std::to_string(size) + "; it must be 2 to 2048");
    }
    model::ScalarImage image;
    image.size = glm::ivec3(size);
    const double middle = 0.5 * (size - 1), turns = 2 * std::numbers::pi / (0.22 * size);
    image.voxel_to_world[3] = glm::dvec4(-middle, -middle, -middle, 1);
    const auto edge = static_cast<std::size_t>(size);
    image.values.resize(edge * edge * edge);
    image.source = "folded ball";
    parallelFor(edge, 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            for (std::size_t j = 0; j < edge; ++j) {
                for (std::size_t i = 0; i < edge; ++i) {
                    const glm::dvec3 p = glm::dvec3(i, j, k) - middle, w = turns * p;
                    const double gyroid =
                        std::sin(w.x) * std::cos(w.y) + std::sin(w.y) * std::cos(w.z) + std::sin(w.z) * std::cos(w.x);
                    image.values[i + edge * (j + edge * k)] =
                        static_cast<float>(100 * (1 - glm::length(p) / (0.42 * size)) + 18 * gyroid);
                }
            }
        }
    });
    return image;
}

}  // namespace radiata
