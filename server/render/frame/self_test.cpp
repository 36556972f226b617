#include "render/frame/self_test.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "gpu/device.h"
#include "render/frame/known_picture.h"

namespace radiata::render {
namespace {

constexpr int kSize = 48;
constexpr double kSilhouette = 0.02;  // mm; pixels whose ray passes a sphere's rim more closely are left out

/// Spheres: only the constant coefficient differs from 0. Radii 0.2 to 0.45 mm on a 4x3x2 grid of 1 mm voxels.
model::ShImage sphereImage() {
    model::ShImage image;
    image.size = glm::ivec3(4, 3, 2);
    image.layout = ShLayout{2, false};
    image.source = "self-test";
    for (int k = 0; k < 2; ++k) {
        for (int j = 0; j < 3; ++j) {
            for (int i = 0; i < 4; ++i) {
                const double radius = 0.2 + 0.25 * ((7 * i + 5 * j + 3 * k) % 11) / 10.0;
                image.voxels.emplace_back(i, j, k);
                image.coefficients.push_back(static_cast<float>(radius * std::sqrt(4 * std::numbers::pi)));
                image.coefficients.insert(image.coefficients.end(), 5, 0.0F);
            }
        }
    }
    return image;
}

model::FrameRequest testRequest(model::Traversal traversal) {
    model::FrameRequest request;
    request.width = request.height = kSize;
    request.scene.layers.emplace_back();
    request.scene.layers[0].glyphs().scale = {model::ScaleMode::kAbsolute, 1.0F};
    request.camera.eye_mm = {6, 5, 9};
    request.camera.target_mm = {1.5, 1, 0.5};
    request.camera.perspective = true;
    request.camera.field_of_view_deg = 28;
    request.quality.traversal = traversal;
    request.quality.pole_table = model::PoleTable::kOff;
    return request;
}

struct Expected {
    int voxel = -1;       // index in the image; -1: nothing
    double depth = 0;     // along the line of sight, from the eye
    bool decided = true;  // false: too near a silhouette to tell
};

Expected expectedPixel(const model::ShImage& image, const model::Camera& camera, int x, int y) {
    const model::CameraFrame axes = model::cameraFrame(camera);
    const double tangent = std::tan(0.5 * camera.field_of_view_deg * std::numbers::pi / 180);
    const double u = (2.0 * (x + 0.5) / kSize - 1) * tangent, v = (1 - 2.0 * (y + 0.5) / kSize) * tangent;
    const glm::dvec3 direction = glm::normalize(axes.forward + u * axes.right + v * axes.up);
    Expected expected;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < image.voxels.size(); ++i) {
        const double radius = image.coefficients[i * 6] / std::sqrt(4 * std::numbers::pi);
        const glm::dvec3 to_centre = glm::dvec3(image.voxels[i]) - camera.eye_mm;
        const double along = glm::dot(to_centre, direction);
        const double distance = glm::length(to_centre - along * direction);
        if (std::abs(distance - radius) < kSilhouette) expected.decided = false;
        if (distance >= radius) continue;
        const double t = along - std::sqrt(radius * radius - distance * distance);
        if (t < nearest) {
            nearest = t;
            expected.voxel = static_cast<int>(i);
            expected.depth = t * glm::dot(direction, axes.forward);
        }
    }
    return expected;
}

bool pictureIsRight(const model::ShImage& image, const model::FrameRequest& request, double depth_offset,
                    const model::FramePixels& pixels) {
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const Expected expected = expectedPixel(image, request.camera, x, y);
            if (!expected.decided) continue;
            const std::size_t at = static_cast<std::size_t>(y) * kSize + static_cast<std::size_t>(x);
            const bool nothing = pixels.id[4 * at] < 0;
            if (nothing != (expected.voxel < 0)) return false;
            if (nothing) continue;
            const glm::ivec3 voxel(pixels.id[4 * at + 1], pixels.id[4 * at + 2], pixels.id[4 * at + 3]);
            if (voxel != image.voxels[static_cast<std::size_t>(expected.voxel)]) return false;
            if (std::abs(pixels.depth[at] + depth_offset - expected.depth) > 1e-4) return false;
        }
    }
    return true;
}

bool pathWorks(gpu::Device& device, Drawer& drawer, const std::shared_ptr<const store::GlyphDataset>& dataset,
               model::Traversal traversal) {
    try {
        const model::FrameRequest request = testRequest(traversal);
        GlyphScene scene(device, dataset, request.scene.layers[0].glyphs(), {1.5, 1, 0.5});
        plan::Abilities all;
        all.ray_query = all.raster = true;
        DrawnLayer layer;
        layer.glyphs = &scene;
        layer.bounds = scene.bounds();
        const auto facts = [&](const auto& camera) { return scene.facts(camera, kSize, kSize); };
        const KnownPicture picture = drawKnownPicture(device, drawer, request, layer, facts, all);
        return pictureIsRight(dataset->image(), request, picture.depth_offset_mm, picture.pixels);
    } catch (const Error&) {
        return false;
    }
}

}  // namespace

plan::Abilities selfTest(gpu::Device& device, Drawer& drawer) {
    const auto dataset = std::make_shared<const store::GlyphDataset>(device, "self-test", sphereImage());
    plan::Abilities abilities;
    abilities.software = device.info().software;
    abilities.float64 = device.has(gpu::Feature::kFloat64);
    abilities.ray_query =
        device.has(gpu::Feature::kRayQuery) && pathWorks(device, drawer, dataset, model::Traversal::kRayQuery);
    abilities.bvh = pathWorks(device, drawer, dataset, model::Traversal::kBvh);
    abilities.tiles = pathWorks(device, drawer, dataset, model::Traversal::kTiles);
    abilities.raster = device.has(gpu::Feature::kRaster) && pathWorks(device, drawer, dataset, model::Traversal::kRasterBoxes);
    if (!abilities.ray_query && !abilities.bvh && !abilities.tiles) {
        throw Error(Code::kUnavailable, "device '" + device.info().name + "' (" + device.info().driver +
                                            "): the self-test's picture is wrong on every traversal path");
    }
    return abilities;
}

}  // namespace radiata::render
