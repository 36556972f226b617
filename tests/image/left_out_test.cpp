// What a picture leaves out of its layers of glyphs, and that it says so: bands, voxels that are not finite, sizes beyond
// float32, glyphs without a lobe to show.
#include <cmath>

#include "image/fixture.h"

namespace radiata::test {
namespace {

class LeftOut : public ImageTest {
protected:
    std::vector<model::LeftOut> leftOut(const model::FrameRequest& request) { return draw(request).info.left_out; }
};

TEST_F(LeftOut, OfACompleteLayerIsNothing) {
    const model::ShImage image = randomField({4, false}, {2, 1, 1}, 61, glm::dmat4(1.0));
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 32, 24, 1);
    request.camera = cameraAround(image, {0.1, 0.2, 1}, true);
    EXPECT_TRUE(leftOut(request).empty());
    // What a selection leaves out is told as a subset.
    request.scene.layers[0].glyphs().selection = {model::Region::kSlab, model::Plane::kAxial, glm::dvec3(900), {0, 0, 1}, 1};
    EXPECT_TRUE(leftOut(request).empty());
}

TEST_F(LeftOut, AreBandsVoxelsAndGlyphsByLayer) {
    model::ShImage even = randomField({8, false}, {4, 1, 1}, 62, glm::dmat4(1.0));
    even.rejected_voxels = 37;
    const std::size_t stride = even.layout.count();
    for (std::size_t c = 0; c < stride; ++c) {
        even.coefficients[c] *= 2e38F;                      // the first too large
        even.coefficients[stride + c] = c == 0 ? -1.F : 0;  // the second negative everywhere
    }
    store.add("even", even);
    store.add("full", randomField({5, true}, {4, 1, 1}, 63, glm::dmat4(1.0)));
    model::FrameRequest request = requestOf("even", 32, 24, 1);
    request.camera = cameraAround(even, {0.1, 0.2, 1}, true);
    // An odd limit of even bands is the band below it.
    request.scene.layers[0].glyphs().lmax = 5;
    request.scene.layers.push_back(request.scene.layers[0]);
    request.scene.layers[1].glyphs().dataset_id = "full";
    model::Frame frame = draw(request);
    EXPECT_EQ(frame.info.left_out, (std::vector<model::LeftOut>{{0, 4, 8, 37, 1, 1}}));
    EXPECT_EQ(frame.info.glyphs, 6U);
    EXPECT_EQ(model::leftOutTexts(frame.info.left_out[0], true),
              (std::vector<std::string>{
                  "layer 0: bands to 4 of 8 drawn", "layer 0: 1 glyph left out: too large or small for float32",
                  "layer 0: 37 voxels left out: NaN or infinity", "layer 0: 1 glyph left out: no lobe to show"}));
    request.scene.layers[1].glyphs().lmax = 3;
    request.scene.layers[0].glyphs().lmax.reset();
    request.scene.layers[0].glyphs().negative_lobes = model::NegativeLobes::kShown;
    frame = draw(request);
    EXPECT_EQ(frame.info.left_out, (std::vector<model::LeftOut>{{0, 8, 8, 37, 1, 0}, {1, 3, 5, 0, 0, 0}}));
}

/// Every size either gives the picture of size 1 or is left out and counted.
TEST_F(LeftOut, IsEveryGlyphThatFloatCannotHold) {
    for (const ShLayout layout : {ShLayout{4, false}, ShLayout{16, false}}) {
        const model::ShImage image = randomField(layout, {2, 2, 1}, 64, glm::dmat4(1.0));
        const std::string name = "k" + std::to_string(layout.lmax) + "-";
        store.add(name + "one", image);
        model::FrameRequest request = requestOf(name + "one", 48, 32, 1);
        request.camera = cameraAround(image, {0.1, 0.2, 1}, true);
        request.scene.layers[0].glyphs().scale = {model::ScaleMode::kGlobal, 1};
        const model::Frame one = draw(request);
        ASSERT_GT(one.info.hit_pixels, 100U);
        int drawn = 0, left_out = 0;
        for (const int exponent :
             {-44, -38, -30, -20, -19, -18, -17, -16, -15, -14, -8, 8, 12, 13, 14, 15, 16, 17, 18, 19, 20, 30, 37}) {
            model::ShImage sized = image;
            for (float& c : sized.coefficients) c = static_cast<float>(static_cast<double>(c) * std::pow(10.0, exponent));
            const std::string id = name + std::to_string(exponent + 44);
            store.add(id, sized);
            request.scene.layers[0].glyphs().dataset_id = id;
            const model::Frame frame = draw(request);
            const std::uint64_t missing = frame.info.left_out.empty() ? 0 : frame.info.left_out[0].glyphs_out_of_range;
            EXPECT_EQ(frame.info.glyphs + missing, 4U) << "10^" << exponent;
            EXPECT_EQ(frame.info.capped_rays, 0U) << "10^" << exponent;
            if (missing == 0) {
                const double off = static_cast<double>(frame.info.hit_pixels) - static_cast<double>(one.info.hit_pixels);
                EXPECT_LE(std::abs(off), 4) << "10^" << exponent << ", k " << layout.lmax;
            }
            ++(missing == 0 ? drawn : left_out);
        }
        EXPECT_GT(drawn, 5);
        EXPECT_GT(left_out, 1);
    }
}

}  // namespace
}  // namespace radiata::test
