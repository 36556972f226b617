// Tensor glyphs in pictures: through their bands and on their components by each method, ellipsoids, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "build/stiffness_field.h"
#include "image/fixture.h"
#include "math/tensor_sh.h"

namespace radiata::test {
namespace {

using model::Intersection;

class TensorPictures : public ImageTest {
protected:
    /// Four tensors of order 2 in a row: a sphere, a needle, a disc across the axes and one with a negative eigenvalue.
    static model::ShImage order2() {
        const TensorSh map(2);
        model::ShImage image;
        image.size = {4, 1, 1};
        image.voxel_to_world = glm::dmat4(2.0);
        image.voxel_to_world[3][3] = 1;
        image.layout = map.layout();
        image.tensor_order = 2;
        image.tensor_format = "symmetric";
        const double tensors[4][6] = {
            {1, 0, 0, 1, 0, 1}, {1, 0.3, 0.2, 0.4, 0.1, 0.3}, {0.8, 0.4, 0, 0.8, 0, 0.1}, {1, 0.2, 0.1, 0.6, 0, -0.5}};
        for (int i = 0; i < 4; ++i) {
            image.voxels.emplace_back(i, 0, 0);
            std::vector<double> coefficients(6);
            map.toSh(tensors[i], coefficients);
            for (const double value : tensors[i]) image.tensors.push_back(static_cast<float>(value));
            for (const double value : coefficients) image.coefficients.push_back(static_cast<float>(value));
        }
        return image;
    }

    static model::FrameRequest brickRequest(const model::ShImage& image) {
        model::FrameRequest request = requestOf("brick", 160, 120, 0.05F);
        request.scene.layers[0].glyphs().scale = {model::ScaleMode::kGlobal, 1};
        request.scene.layers[0].glyphs().tensor = model::TensorShape::kReynolds;
        request.camera = cameraAround(image, {0.4, -1, 0.6}, true);
        request.quality.samples = 1;
        return request;
    }
};

TEST_F(TensorPictures, OfAStiffnessFieldAreTheSameByEveryMethod) {
    const model::ShImage image = stiffnessImage({.seed = 3, .size = 6});
    store.add("brick", image);
    model::FrameRequest request = brickRequest(image);
    const model::Frame march = draw(request);
    EXPECT_EQ(march.info.passes[0].shader.substr(0, 6), "glyph_");
    const double radius = 4;  // half a voxel of 8 mm
    for (const Intersection method : {Intersection::kTensorMarch, Intersection::kTensorInterval, Intersection::kTensorAffine}) {
        request.quality.intersection = method;
        request.quality.tensor_march = {.step = 0.01F, .bisections = 3, .interpolate = true, .adaptive = true, .depth = 12};
        const model::Frame frame = draw(request);
        const Agreement agreement = compareSurfaces(march, frame);
        std::printf("method %d: %d pixels, %d of another glyph, %.1e mm apart along the normal\n", static_cast<int>(method),
                    agreement.hits, agreement.other_ids, agreement.worst_apart);
        EXPECT_GT(agreement.hits, 4000);
        EXPECT_LE(agreement.other_ids, agreement.hits / 200) << static_cast<int>(method);
        EXPECT_LT(agreement.worst_apart, 0.01 * radius) << static_cast<int>(method);
        EXPECT_NE(frame.info.passes[0].shader.find("_tensor4"), std::string::npos);
        EXPECT_FALSE(frame.info.pole_table_used);
        EXPECT_EQ(frame.info.capped_rays, 0U);
        // Normals from the components' gradient and from the bands'.
        double worst_cosine = 1;
        for (std::size_t i = 0; i < march.pixels.depth.size(); ++i) {
            if (march.pixels.id[4 * i] < 0 ||
                !std::equal(&march.pixels.id[4 * i], &march.pixels.id[4 * i] + 4, &frame.pixels.id[4 * i]) ||
                std::abs(march.pixels.depth[i] - frame.pixels.depth[i]) > 1e-3F) {
                continue;
            }
            const auto at = [i](const model::Frame& f) {
                return glm::dvec3(f.pixels.normal[3 * i], f.pixels.normal[3 * i + 1], f.pixels.normal[3 * i + 2]);
            };
            worst_cosine = std::min(worst_cosine, glm::dot(at(march), at(frame)));
        }
        EXPECT_GT(worst_cosine, 0.999);
    }
}

TEST_F(TensorPictures, DoNotDependOnTheTraversal) {
    const model::ShImage image = stiffnessImage({.seed = 4, .size = 4});
    store.add("brick", image);
    model::FrameRequest request = brickRequest(image);
    request.quality.intersection = Intersection::kTensorMarch;
    request.quality.traversal = model::Traversal::kTiles;
    const model::Frame tiles = draw(request);
    EXPECT_GT(tiles.info.hit_pixels, 2000U);
    for (const model::Traversal traversal : {model::Traversal::kBvh, model::Traversal::kRayQuery}) {
        request.quality.traversal = traversal;
        EXPECT_EQ(draw(request).pixels.rgba, tiles.pixels.rgba);
    }
}

TEST_F(TensorPictures, EllipsoidsAreExact) {
    const model::ShImage image = order2();
    store.add("tensors", image);
    model::FrameRequest request = requestOf("tensors", 200, 80, 1);
    request.scene.layers[0].glyphs().tensor = model::TensorShape::kEllipsoid;
    request.scene.layers[0].glyphs().scale = {model::ScaleMode::kAbsolute, 0.9F};
    request.camera = cameraAround(image, {0.3, -1, 0.5}, true);
    request.quality.samples = 1;
    for (const model::Traversal traversal : {model::Traversal::kTiles, model::Traversal::kBvh, model::Traversal::kRayQuery}) {
        request.quality.traversal = traversal;
        const model::Frame frame = draw(request);
        EXPECT_GT(frame.info.hit_pixels, 1200U);
        EXPECT_NE(frame.info.passes[0].shader.find("_ellipsoid"), std::string::npos);
        double worst = 0, worst_normal = 0;
        for (std::size_t i = 0; i < frame.pixels.depth.size(); ++i) {
            const int voxel = frame.pixels.id[4 * i + 1];
            if (voxel < 0 || voxel == 3) continue;
            const float* t = image.tensors.data() + 6 * voxel;
            const glm::dmat3 inverse = glm::inverse(glm::dmat3(t[0], t[1], t[2], t[1], t[3], t[4], t[2], t[4], t[5]));
            const auto at = [i](const std::vector<float>& v) { return glm::dvec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]); };
            const glm::dvec3 p =
                (frame.info.position_origin_mm + at(frame.pixels.position) - voxelCentre(image, {voxel, 0, 0})) / 0.9;
            worst = std::max(worst, std::abs(glm::length(inverse * p) - 1));
            worst_normal =
                std::max(worst_normal, glm::length(glm::normalize(inverse * (inverse * p)) - at(frame.pixels.normal)));
        }
        EXPECT_LT(worst, 2e-4);
        EXPECT_LT(worst_normal, 2e-3);
    }
    // They are met once; a pick of all hits is refused where it meets one.
    request.quality.intersection = Intersection::kMarch;
    EXPECT_TRUE(renderer.pick(request, 100, 40) || renderer.pick(request, 60, 40));
    EXPECT_EQ(codeOf([&] {
                  renderer.pick(request, 100, 40, 0, true);
                  renderer.pick(request, 60, 40, 0, true);
              }),
              Code::kInvalidArgument);
    // The Reynolds glyph touches its ellipsoid at the ends of the axes and lies outside of it elsewhere.
    const model::Frame ellipsoids = draw(request);
    request.scene.layers[0].glyphs().tensor = model::TensorShape::kReynolds;
    request.scene.layers[0].glyphs().negative_lobes = model::NegativeLobes::kShown;
    EXPECT_GT(draw(request).info.hit_pixels, ellipsoids.info.hit_pixels);
}

TEST_F(TensorPictures, AreRefusedWhereTheyDoNotFitTheData) {
    const model::ShImage brick = stiffnessImage({.seed = 5, .size = 2});
    store.add("brick", brick);
    store.add("bands", randomField({4, false}, {2, 2, 1}, 37, glm::dmat4(1.0)));
    model::FrameRequest request = brickRequest(brick);
    const auto refused = [&](Code code, const std::string& words) {
        try {
            draw(request);
            ADD_FAILURE() << "drawn; should have said: " << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), code) << error.what();
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
        request = brickRequest(brick);
    };
    request.scene.layers[0].glyphs().tensor = model::TensorShape::kEllipsoid;
    refused(Code::kInvalidArgument, "only order 2 has ellipsoids");
    request.scene.layers[0].glyphs().dataset_id = "bands";
    refused(Code::kInvalidArgument, "holds spherical harmonics; draw it as a layer of glyphs");
    request.scene.layers[0].glyphs().dataset_id = "bands";
    request.scene.layers[0].glyphs().tensor.reset();
    request.quality.intersection = Intersection::kTensorAffine;
    refused(Code::kUnsupported, "tensor-affine draws Cartesian tensors, but dataset 'bands'");
    request.quality.intersection = Intersection::kTensorMarch;
    request.scene.layers[0].glyphs().lmax = 2;
    refused(Code::kInvalidArgument, "draws whole tensors, here of order 4");
    for (const float step : {0.0F, -1.0F, 0.6F, std::numeric_limits<float>::quiet_NaN()}) {
        request.quality.tensor_march.step = step;
        refused(Code::kInvalidArgument, "quality.tensor_march.step");
    }
    request.quality.tensor_march.bisections = 4;
    refused(Code::kInvalidArgument, "quality.tensor_march.bisections is 4; it must be 0 to 3");
    request.quality.tensor_march.depth = 17;
    refused(Code::kInvalidArgument, "quality.tensor_march.depth is 17");
}

}  // namespace
}  // namespace radiata::test
