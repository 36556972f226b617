#include "build/phantom_anatomy.h"

#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "build/phantom_tissue.h"

namespace radiata {
namespace {

double brightness(phantom::Tissue tissue) {
    switch (tissue) {
        case phantom::Tissue::kOutside:
            return 0;
        case phantom::Tissue::kFluid:
            return 20;
        case phantom::Tissue::kGrey:
            return 70;
        case phantom::Tissue::kWhite:
            return 100;
    }
    return 0;
}

}  // namespace

model::ScalarImage phantomAnatomy(std::uint64_t seed, double voxel_mm) {
    if (!(voxel_mm >= 0.25 && voxel_mm <= 20)) {
        throw Error(Code::kInvalidArgument,
                    "the anatomy's voxels have an edge of " + std::to_string(voxel_mm) + " mm; it must be 0.25 to 20");
    }
    const glm::dvec3 low(phantom::kHeadMin[0], phantom::kHeadMin[1], phantom::kHeadMin[2]);
    const glm::dvec3 high(phantom::kHeadMax[0], phantom::kHeadMax[1], phantom::kHeadMax[2]);
    model::ScalarImage image;
    image.size = glm::ivec3(glm::ceil((high - low) / voxel_mm)) + 4;
    const glm::dvec3 first = 0.5 * (low + high) - 0.5 * voxel_mm * glm::dvec3(image.size - 1);
    image.voxel_to_world = glm::dmat4(voxel_mm);
    image.voxel_to_world[3] = glm::dvec4(first, 1);
    image.source = "phantom anatomy";
    const auto width = static_cast<std::size_t>(image.size.x);
    const std::size_t rows = static_cast<std::size_t>(image.size.y) * static_cast<std::size_t>(image.size.z);
    image.values.resize(width * rows);
    parallelFor(rows, 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            const int j = static_cast<int>(row) % image.size.y, k = static_cast<int>(row) / image.size.y;
            for (int i = 0; i < image.size.x; ++i) {
                double sum = 0;
                for (int n = 0; n < 8; ++n) {
                    const glm::dvec3 within = 0.5 * glm::dvec3(n & 1, n >> 1 & 1, n >> 2) - 0.25;
                    sum += brightness(phantom::tissueAt(first + voxel_mm * (glm::dvec3(i, j, k) + within), seed).tissue);
                }
                image.values[row * width + static_cast<std::size_t>(i)] = static_cast<float>(sum / 8);
            }
        }
    });
    return image;
}

}  // namespace radiata
