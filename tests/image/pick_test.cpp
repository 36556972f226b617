// Picks: the pixel that is asked for answers as the lossless outputs of the whole picture do, and the function agrees with it.
#include <cmath>
#include <iostream>

#include "image/fixture.h"
#include "reference/sh_function.h"

namespace radiata::test {
namespace {

class Picks : public ImageTest {
protected:
    std::optional<model::PickedGlyph> pickGlyph(const model::FrameRequest& request, int x, int y) {
        const std::optional<model::Picked> picked = renderer.pick(request, x, y);
        if (!picked) return std::nullopt;
        return std::get<model::PickedGlyph>(*picked);
    }
};

/// Each pixel of small pictures, in perspective from the side and orthographic close up; two layers, both lobes, a band limit.
TEST_F(Picks, AnswerAsTheOutputsOfThePicture) {
    const model::ShImage first = randomField({6, false}, {3, 3, 2}, 81, obliqueAffine());
    model::ShImage second = randomField({5, true}, {4, 2, 2}, 82, obliqueAffine());
    second.voxel_to_world[3] += glm::dvec4(0.3, -0.4, 0.2, 0);
    store.add("first", first);
    store.add("second", second);
    model::FrameRequest request = requestOf("first", 16, 12, 2);
    request.scene.layers[0].glyphs().negative_lobes = model::NegativeLobes::kShown;
    request.scene.layers[0].glyphs().lmax = 5;
    request.scene.layers.push_back(request.scene.layers[0]);
    request.scene.layers[1].glyphs().dataset_id = "second";
    request.scene.layers[1].glyphs().lmax.reset();
    request.quality.samples = 1;
    double worst_place = 0, worst_radius = 0, worst_amplitude = 0;
    int hits = 0, negative = 0;
    for (const bool perspective : {true, false}) {
        request.camera = cameraAround(first, {1, 2, 3}, perspective);
        const model::Frame frame = draw(request);
        for (int y = 0; y < request.height; ++y) {
            for (int x = 0; x < request.width; ++x) {
                const auto at = static_cast<std::size_t>(y * request.width + x);
                const auto picked = pickGlyph(request, x, y);
                ASSERT_EQ(picked.has_value(), frame.pixels.id[4 * at] >= 0) << x << ", " << y;
                if (!picked) continue;
                ++hits;
                EXPECT_EQ(picked->layer, frame.pixels.id[4 * at]);
                EXPECT_EQ(picked->dataset_id, picked->layer == 0 ? "first" : "second");
                for (int c = 0; c < 3; ++c)
                    EXPECT_EQ(picked->voxel[c], frame.pixels.id[4 * at + 1 + static_cast<std::size_t>(c)]);
                glm::dvec3 place = frame.info.position_origin_mm;
                for (int c = 0; c < 3; ++c)
                    place[c] += static_cast<double>(frame.pixels.position[3 * at + static_cast<std::size_t>(c)]);
                worst_place = std::max(worst_place, glm::length(place - picked->position_mm));
                EXPECT_LT(glm::length(picked->centre_mm - voxelCentre(picked->layer == 0 ? first : second, picked->voxel)),
                          1e-9);
                // 2 mm per unit of amplitude; the band limit of 5 leaves the even layer its bands to 4.
                EXPECT_EQ(picked->layout, (picked->layer == 0 ? ShLayout{4, false} : ShLayout{5, true}));
                const reference::ShFunction f(picked->layout, std::span<const float>(picked->coefficients));
                worst_amplitude = std::max(worst_amplitude, std::abs(f(picked->direction) - picked->amplitude));
                worst_radius = std::max(worst_radius, std::abs(glm::length(place - picked->centre_mm) - picked->radius_mm));
                EXPECT_NEAR(picked->radius_mm, 2 * std::abs(picked->amplitude), 1e-6);
                negative += picked->amplitude < 0;
            }
        }
    }
    std::cout << hits << " pixels, " << negative << " of negative lobes; worst place " << worst_place << " mm, radius "
              << worst_radius << " mm\n";
    EXPECT_GT(hits, 200);
    EXPECT_GT(negative, 2);
    EXPECT_LT(worst_place, 1e-4);
    EXPECT_LT(worst_radius, 1e-4);
    EXPECT_LT(worst_amplitude, 1e-10);
}

TEST_F(Picks, DoNotDependOnHowThePictureIsDrawn) {
    const model::ShImage image = randomField({4, false}, {3, 3, 2}, 83, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 640, 480, 2);
    request.camera = cameraAround(image, {1, 2, 3}, true);
    const auto plain = pickGlyph(request, 320, 240);
    ASSERT_TRUE(plain);
    request.quality.traversal = model::Traversal::kTiles;
    request.quality.intersection = model::Intersection::kPolynomial;
    request.quality.samples = 64;
    request.scene.layers[0].glyphs().colour.mode = model::ColourMode::kRadius;
    request.scene.light.irradiance = 0;
    // A picture in the making is not disturbed.
    request.quality.intersection = model::Intersection::kMarch;
    render::Target target;
    renderer.render(target, request, 0, 1);
    const auto other = pickGlyph(request, 320, 240);
    ASSERT_TRUE(other);
    EXPECT_EQ(other->position_mm, plain->position_mm);
    EXPECT_EQ(other->amplitude, plain->amplitude);
    const model::Frame split = renderer.render(target, request, 1, 2);
    request.quality.samples = 3;
    EXPECT_EQ(split.pixels.rgba, renderer.renderAll(request).pixels.rgba);
}

TEST_F(Picks, OutsideThePictureAreRefusedAndBesideTheGlyphsAreNothing) {
    const model::ShImage image = randomField({2, false}, {2, 2, 2}, 84, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 64, 48, 1);
    request.camera = cameraAround(image, {1, 2, 3}, true);
    EXPECT_FALSE(renderer.pick(request, 0, 0));
    for (const auto& [x, y] : {std::pair{64, 0}, {0, 48}, {-1, 0}, {0, -1}, {2147483647, 0}}) {
        EXPECT_EQ(codeOf([&, px = x, py = y] { renderer.pick(request, px, py); }), Code::kInvalidArgument);
    }
    request.scene.layers[0].glyphs().selection = {model::Region::kSlab, model::Plane::kAxial, glm::dvec3(900), {0, 0, 1}, 1};
    EXPECT_FALSE(renderer.pick(request, 32, 24)) << "a layer without glyphs";
    request.scene.layers[0].glyphs().dataset_id = "nowhere";
    EXPECT_EQ(codeOf([&] { renderer.pick(request, 0, 0); }), Code::kNotFound);
}

}  // namespace
}  // namespace radiata::test
