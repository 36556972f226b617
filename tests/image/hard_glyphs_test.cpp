// Glyphs that solvers get wrong: high bands, single coefficients, nothing but a constant, odd bands under a limit, no visible
// lobe.
#include <iostream>
#include <set>

#include "image/exact_check.h"
#include "image/fixture.h"

namespace radiata::test {
namespace {

class HardGlyphs : public ImageTest {
protected:
    model::Frame hold(const model::FrameRequest& request, const model::ShImage& image, int pixels, int hits_at_least) {
        model::Frame frame = draw(request);
        const ExactCheck check = checkAgainstReference(frame, image, pixels);
        std::cout << check << '\n';
        EXPECT_EQ(check.wrong(), 0) << check;
        EXPECT_GE(check.checked, hits_at_least);
        EXPECT_EQ(frame.info.capped_rays, 0U);
        return frame;
    }
};

TEST_F(HardGlyphs, OfBandSixteen) {
    for (const bool full : {false, true}) {
        const model::ShImage image = randomField({16, full}, {3, 2, 1}, 31, obliqueAffine());
        const std::string id = full ? "full16" : "even16";
        store.add(id, image);
        model::FrameRequest request = requestOf(id, 160, 120, 2);
        request.scene.layers[0].glyphs().negative_lobes = full ? model::NegativeLobes::kHidden : model::NegativeLobes::kShown;
        request.camera = cameraAround(image, {1, -1, 2}, true);
        hold(request, image, 300, 100);
    }
}

TEST_F(HardGlyphs, OfASingleCoefficient) {
    // One for each coefficient up to band 8: lobes of one size, zeros on whole planes and cones through the centre.
    model::ShImage image = randomField({8, false}, {9, 5, 1}, 32, obliqueAffine());
    const std::size_t stride = image.layout.count();
    for (std::size_t i = 0; i < image.voxels.size(); ++i) {
        for (std::size_t c = 0; c < stride; ++c) image.coefficients[i * stride + c] = c == i ? 0.8F : 0.0F;
    }
    store.add("single", image);
    model::FrameRequest request = requestOf("single", 200, 150, 1.2F);
    for (const model::NegativeLobes lobes : {model::NegativeLobes::kShown, model::NegativeLobes::kHidden}) {
        request.scene.layers[0].glyphs().negative_lobes = lobes;
        request.camera = cameraAround(image, {1, 1, 3}, false);
        hold(request, image, 1000, 100);
    }
}

TEST_F(HardGlyphs, LimitedToFewBands) {
    const model::ShImage image = randomField({8, false}, {4, 3, 2}, 33, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 160, 120, 2);
    request.camera = cameraAround(image, {3, 1, 2}, true);
    for (const int lmax : {0, 2, 5}) {
        request.scene.layers[0].glyphs().lmax = lmax;
        const model::Frame frame = hold(request, image, 500, 100);
        EXPECT_EQ(frame.info.request.scene.layers[0].glyphs().lmax, lmax);
    }
    request.scene.layers[0].glyphs().lmax = 10;
    EXPECT_EQ(codeOf([&] { draw(request); }), Code::kInvalidArgument);
}

TEST_F(HardGlyphs, LimitedInsideAFullBasisEqualTheCutImage) {
    const model::ShImage image = randomField({8, true}, {4, 3, 2}, 34, obliqueAffine());
    store.add("full", image);
    for (const int lmax : {1, 3, 4}) {
        model::ShImage cut = image;
        cut.layout.lmax = lmax;
        cut.coefficients.clear();
        for (std::size_t i = 0; i < image.voxels.size(); ++i) {
            const float* first = image.coefficients.data() + i * image.layout.count();
            cut.coefficients.insert(cut.coefficients.end(), first, first + cut.layout.count());
        }
        const std::string id = "cut" + std::to_string(lmax);
        store.add(id, cut);
        model::FrameRequest request = requestOf("full", 160, 120, 2);
        request.camera = cameraAround(image, {3, 1, 2}, true);
        request.scene.layers[0].glyphs().lmax = lmax;
        const model::Frame limited = hold(request, image, 300, 50);
        request.scene.layers[0].glyphs().dataset_id = id;
        request.scene.layers[0].glyphs().lmax.reset();
        const model::Frame whole = draw(request);
        EXPECT_EQ(compareSurfaces(limited, whole).other_ids, 0);
        EXPECT_EQ(limited.pixels.rgba, whole.pixels.rgba);
    }
}

TEST_F(HardGlyphs, WithoutAnyVisibleLobe) {
    model::ShImage image = randomField({4, false}, {3, 1, 1}, 35, glm::dmat4(1.0));
    const std::size_t stride = image.layout.count();
    for (std::size_t c = 0; c < stride; ++c) {
        image.coefficients[c] = 0;                               // the first is zero
        image.coefficients[stride + c] = c == 0 ? -0.8F : 0.0F;  // the second negative everywhere
    }
    store.add("odd", image);
    model::FrameRequest request = requestOf("odd", 90, 60, 1);
    request.camera = cameraAround(image, {0.1, 0.2, 1}, true);
    const auto shown = [&](const model::Frame& frame) {
        std::set<int> voxels;
        for (std::size_t at = 0; at < frame.pixels.id.size(); at += 4) {
            if (frame.pixels.id[at] >= 0) voxels.insert(frame.pixels.id[at + 1]);
        }
        return voxels;
    };
    EXPECT_EQ(shown(draw(request)), (std::set<int>{2}));
    request.scene.layers[0].glyphs().negative_lobes = model::NegativeLobes::kShown;
    EXPECT_EQ(shown(draw(request)), (std::set<int>{1, 2}));
}

TEST_F(HardGlyphs, AreAbsentFromAnEmptyImage) {
    model::ShImage image = randomField({4, false}, {3, 3, 3}, 36, obliqueAffine());
    const model::Camera camera = cameraAround(image, {1, 2, 3}, true);
    const model::ShImage field = image;
    image.voxels.clear();
    image.coefficients.clear();
    store.add("nothing", image);
    store.add("field", field);
    model::FrameRequest request = requestOf("nothing", 64, 48, 1);
    request.camera = camera;
    request.scene.background = glm::vec3(0, 1, 0);
    for (const model::Traversal traversal : {model::Traversal::kTiles, model::Traversal::kBvh, model::Traversal::kRayQuery}) {
        request.quality.traversal = traversal;
        request.quality.pole_table = model::PoleTable::kOn;
        const model::Frame frame = draw(request);
        EXPECT_EQ(frame.info.glyphs, 0U);
        EXPECT_EQ(frame.info.hit_pixels, 0U);
        for (std::size_t at = 0; at < frame.pixels.rgba.size(); at += 4) {
            ASSERT_EQ(frame.pixels.rgba[at] + frame.pixels.rgba[at + 2], 0);
            ASSERT_EQ(frame.pixels.rgba[at + 1], 255);
        }
        // Beside a layer with glyphs, before it and after it, the empty one changes nothing.
        model::FrameRequest alone = requestOf("field", 64, 48, 2);
        alone.camera = camera;
        alone.quality.traversal = traversal;
        const model::Frame expected = draw(alone);
        EXPECT_GT(expected.info.hit_pixels, 100U);
        for (const int place : {0, 1}) {
            model::FrameRequest both = alone;
            both.scene.layers.insert(both.scene.layers.begin() + place, request.scene.layers[0]);
            EXPECT_EQ(draw(both).pixels.rgba, expected.pixels.rgba);
        }
    }
    EXPECT_NO_THROW(renderer.fitCamera("nothing", {}, model::Convention::kRadiological, 1));
}

}  // namespace
}  // namespace radiata::test
