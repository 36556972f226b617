#include "image/scenes.h"

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>

#include <glm/gtc/matrix_transform.hpp>

#include "build/glyph_instances.h"
#include "build/phantom.h"

namespace radiata::test {

model::ShImage randomField(ShLayout layout, const glm::ivec3& size, std::uint32_t seed, const glm::dmat4& voxel_to_world) {
    std::mt19937 random(seed);
    const auto unit = [&] { return static_cast<float>(static_cast<double>(random()) / 2147483648.0 - 1.0); };
    model::ShImage image;
    image.size = size;
    image.voxel_to_world = voxel_to_world;
    image.layout = layout;
    image.source = "random field";
    for (int k = 0; k < size.z; ++k) {
        for (int j = 0; j < size.y; ++j) {
            for (int i = 0; i < size.x; ++i) {
                image.voxels.emplace_back(i, j, k);
                const std::size_t first = image.coefficients.size();
                image.coefficients.resize(first + layout.count());
                for (int l = 0; l <= layout.lmax; l += layout.step()) {
                    for (int m = -l; m <= l; ++m) {
                        image.coefficients[first + layout.index(l, m)] = unit() / static_cast<float>(1 + l);
                    }
                }
                image.coefficients[first] = 0.6F;
            }
        }
    }
    return image;
}

glm::dmat4 obliqueAffine() {
    glm::dmat4 affine = glm::translate(glm::dmat4(1.0), glm::dvec3(-31, 12.5, 55));
    affine = glm::rotate(affine, 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    return glm::scale(affine, glm::dvec3(-1.2, 1.0, 1.5));
}

model::ShImage phantomImage(int size, int lmax) {
    PhantomOptions options;
    options.size = size;
    options.lmax = lmax;
    return phantomShImage(options);
}

model::ShImage reversedStorage(const model::ShImage& image) {
    model::ShImage reversed = image;
    reversed.voxel_to_world =
        image.voxel_to_world *
        glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(image.size.x - 1, 0, 0)), glm::dvec3(-1, 1, 1));
    reversed.voxels.clear();
    reversed.coefficients.clear();
    const std::size_t stride = image.layout.count();
    for (std::size_t begin = 0; begin < image.voxels.size();) {
        std::size_t end = begin;
        while (end < image.voxels.size() && image.voxels[end].y == image.voxels[begin].y &&
               image.voxels[end].z == image.voxels[begin].z) {
            ++end;
        }
        for (std::size_t i = end; i-- > begin;) {
            reversed.voxels.emplace_back(image.size.x - 1 - image.voxels[i].x, image.voxels[i].y, image.voxels[i].z);
            const auto* from = image.coefficients.data() + i * stride;
            reversed.coefficients.insert(reversed.coefficients.end(), from, from + stride);
        }
        begin = end;
    }
    return reversed;
}

glm::dvec3 voxelCentre(const model::ShImage& image, const glm::ivec3& voxel) {
    return glm::dvec3(image.voxel_to_world * glm::dvec4(glm::dvec3(voxel), 1.0));
}

model::FrameRequest requestOf(const std::string& dataset, int width, int height, float mm_per_amplitude) {
    model::FrameRequest request;
    request.width = width;
    request.height = height;
    request.quality.samples = 1;
    request.scene.layers.emplace_back();
    request.scene.layers[0].glyphs().dataset_id = dataset;
    request.scene.layers[0].glyphs().scale = {model::ScaleMode::kAbsolute, mm_per_amplitude};
    return request;
}

model::Camera cameraAround(const model::ShImage& image, const glm::dvec3& towards, bool perspective) {
    glm::dvec3 low, high;
    datasetBounds(image, low, high);
    // The grid's diagonal: world bounds of a turned grid are much larger than it.
    const double extent =
        std::min(glm::length(high - low), glm::length(glm::dmat3(image.voxel_to_world) * glm::dvec3(image.size)));
    model::Camera camera;
    camera.target_mm = 0.5 * (low + high);
    camera.eye_mm = camera.target_mm + 1.5 * extent * glm::normalize(towards);
    camera.up = std::abs(glm::normalize(towards).z) > 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    camera.perspective = perspective;
    camera.height_mm = 0.6 * extent;
    camera.field_of_view_deg = 2 * std::atan(0.2) * 180 / std::numbers::pi;
    return camera;
}

std::optional<std::filesystem::path> dataFolder() {
    const char* folder = std::getenv("RADIATA_DATA");
    if (folder == nullptr || *folder == '\0') return std::nullopt;
    return std::filesystem::path(folder);
}

}  // namespace radiata::test
