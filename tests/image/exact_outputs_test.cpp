// Depth, id, position, normal and steps of a frame against the double-precision reference, glyph by glyph.
#include <iostream>

#include "image/exact_check.h"
#include "image/fixture.h"

namespace radiata::test {
namespace {

class ExactOutputs : public ImageTest {
protected:
    void hold(const model::FrameRequest& request, const model::ShImage& image, int pixels, int hits_at_least) {
        const ExactCheck check = checkAgainstReference(draw(request), image, pixels);
        std::cout << check << '\n';
        EXPECT_EQ(check.wrong(), 0) << check;
        EXPECT_GE(check.checked, hits_at_least);
        EXPECT_LE(check.undecided, (check.checked + check.empty) / 5);
    }
};

TEST_F(ExactOutputs, AreWhereTheScannerSays) {
    const model::ShImage image = randomField({4, false}, {4, 3, 3}, 21, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 160, 120, 2);
    for (const bool perspective : {true, false}) {
        for (const glm::dvec3& towards : {glm::dvec3(1, 2, 3), glm::dvec3(0, 0, -1)}) {
            request.camera = cameraAround(image, towards, perspective);
            request.quality.pole_table = perspective ? model::PoleTable::kOff : model::PoleTable::kOn;
            hold(request, image, 800, 150);
        }
    }
}

/// The comparison itself must notice: glyphs 0.01 mm beside their place, and one glyph turned into its neighbour.
TEST_F(ExactOutputs, ThatAreWrongAreNoticed) {
    const model::ShImage image = randomField({4, false}, {3, 3, 2}, 25, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 160, 120, 2);
    request.camera = cameraAround(image, {1, 2, 3}, true);
    const model::Frame frame = draw(request);
    model::ShImage moved = image;
    moved.voxel_to_world[3].x += 0.01;
    const ExactCheck beside = checkAgainstReference(frame, moved, 300);
    EXPECT_GT(beside.wrong_depth, beside.checked / 2);
    model::ShImage other = image;
    const auto first = other.coefficients.begin();
    std::copy(first, first + 15, first + 15 * 4);
    EXPECT_GT(checkAgainstReference(frame, other, 2000).wrong(), 10);
}

TEST_F(ExactOutputs, ShowNegativeLobesAndOddBands) {
    const model::ShImage image = randomField({5, true}, {3, 3, 2}, 22, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 160, 120, 2);
    request.camera = cameraAround(image, {-2, 1, 1}, true);
    for (const model::NegativeLobes lobes : {model::NegativeLobes::kShown, model::NegativeLobes::kHidden}) {
        request.scene.layers[0].glyphs().negative_lobes = lobes;
        hold(request, image, 600, 100);
    }
}

TEST_F(ExactOutputs, BeginAndEndAtTheClipPlanes) {
    const model::ShImage image = randomField({4, false}, {4, 4, 3}, 23, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 160, 120, 2);
    for (const bool perspective : {true, false}) {
        request.camera = cameraAround(image, {1, -1, 1}, perspective);
        const double distance = glm::length(request.camera.target_mm - request.camera.eye_mm);
        request.camera.clip = model::Clip{distance - 0.5, distance + 0.6};
        hold(request, image, 800, 100);
    }
}

/// Twelve spheres: everything about them is known without any solver.
TEST_F(ExactOutputs, OfSpheresAreThoseOfSpheres) {
    model::ShImage image = randomField({2, false}, {4, 3, 1}, 24, obliqueAffine());
    const double radius = 0.4;
    for (std::size_t i = 0; i < image.coefficients.size(); ++i) {
        image.coefficients[i] = i % 6 == 0 ? static_cast<float>(radius * std::sqrt(4 * 3.14159265358979323846)) : 0.0F;
    }
    store.add("spheres", image);
    model::FrameRequest request = requestOf("spheres", 160, 120, 1);
    request.camera = cameraAround(image, {1, 1, 1}, true);
    const model::Frame frame = draw(request);
    int hits = 0;
    for (std::size_t at = 0; at < frame.pixels.depth.size(); ++at) {
        if (frame.pixels.id[4 * at] < 0) continue;
        ++hits;
        const glm::ivec3 voxel(frame.pixels.id[4 * at + 1], frame.pixels.id[4 * at + 2], frame.pixels.id[4 * at + 3]);
        const glm::dvec3 position(frame.pixels.position[3 * at], frame.pixels.position[3 * at + 1],
                                  frame.pixels.position[3 * at + 2]);
        const glm::dvec3 offset = position + frame.info.position_origin_mm - voxelCentre(image, voxel);
        const glm::dvec3 normal(frame.pixels.normal[3 * at], frame.pixels.normal[3 * at + 1], frame.pixels.normal[3 * at + 2]);
        ASSERT_NEAR(glm::length(offset), radius, 1e-5) << at;
        ASSERT_LT(glm::length(offset / radius - normal), 1e-3) << at;
    }
    EXPECT_GT(hits, 2000);
    EXPECT_EQ(static_cast<std::uint64_t>(hits), frame.info.hit_pixels);
}

}  // namespace
}  // namespace radiata::test
