// Several layers in one picture: the nearest shows, each with its own opacity, light and background.
#include <cmath>
#include <iostream>

#include "image/fixture.h"
#include "reference/shading.h"

namespace radiata::test {
namespace {

class Layers : public ImageTest {};

TEST_F(Layers, OfDifferentDatasetsHideEachOtherByDepth) {
    const model::ShImage first = randomField({4, false}, {3, 3, 2}, 51, obliqueAffine());
    model::ShImage second = randomField({5, true}, {4, 2, 2}, 52, obliqueAffine());
    second.voxel_to_world[3] += glm::dvec4(0.3, -0.4, 0.2, 0);
    store.add("first", first);
    store.add("second", second);
    model::FrameRequest request = requestOf("first", 160, 120, 3);
    request.camera = cameraAround(first, {1, 2, 3}, true);
    for (const model::Traversal traversal : {model::Traversal::kTiles, model::Traversal::kBvh, model::Traversal::kRayQuery}) {
        request.quality.traversal = traversal;
        request.scene.layers[0].glyphs().dataset_id = "first";
        request.scene.layers.resize(1);
        const model::Frame a = draw(request);
        request.scene.layers[0].glyphs().dataset_id = "second";
        const model::Frame b = draw(request);
        request.scene.layers.push_back(request.scene.layers[0]);
        request.scene.layers[0].glyphs().dataset_id = "first";
        const model::Frame both = draw(request);
        int wrong = 0, of_first = 0, of_second = 0;
        std::uint64_t shown = 0;
        for (std::size_t at = 0; at < both.pixels.depth.size(); ++at) {
            const double depth_a = static_cast<double>(a.pixels.depth[at]) + a.info.depth_offset_mm;
            const double depth_b = static_cast<double>(b.pixels.depth[at]) + b.info.depth_offset_mm;
            shown += std::isfinite(std::min(depth_a, depth_b));
            if (std::abs(depth_a - depth_b) < 1e-4) continue;
            const bool near = depth_a < depth_b;
            const bool nothing = !std::isfinite(std::min(depth_a, depth_b));
            const model::Frame& expected = near ? a : b;
            const int layer = nothing ? -1 : near ? 0 : 1;
            bool right = both.pixels.id[4 * at] == layer;
            for (std::size_t c = 1; c < 4; ++c) right = right && both.pixels.id[4 * at + c] == expected.pixels.id[4 * at + c];
            wrong += !right;
            of_first += layer == 0;
            of_second += layer == 1;
        }
        std::cout << of_first << " pixels of the first layer, " << of_second << " of the second, " << wrong << " wrong\n";
        EXPECT_EQ(wrong, 0);
        EXPECT_GT(of_first, 1000);
        EXPECT_GT(of_second, 1000);
        EXPECT_EQ(both.info.hit_pixels, shown) << "a pixel counts once, however many layers it meets";
        EXPECT_EQ(both.info.glyphs, a.info.glyphs + b.info.glyphs);
    }
}

/// 8 bits of sRGB on both sides: half a step of either picture is at most 0.0046 of linear light.
TEST_F(Layers, MixWithTheBackgroundByTheirOpacity) {
    const model::ShImage image = randomField({4, false}, {3, 3, 2}, 53, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 160, 120, 2);
    request.camera = cameraAround(image, {1, 2, 3}, true);
    request.scene.background = {0.1F, 0.4F, 0.7F};
    const model::Frame opaque = draw(request);
    request.scene.layers[0].opacity = 0.25F;
    const model::Frame clear = draw(request);
    EXPECT_EQ(opaque.pixels.id, clear.pixels.id);
    int compared = 0;
    for (std::size_t at = 0; at < opaque.pixels.rgba.size(); ++at) {
        if (at % 4 == 3 || opaque.pixels.rgba[at] == 255) continue;
        const bool hit = opaque.pixels.id[at - at % 4] >= 0;
        const double background = static_cast<double>(request.scene.background[static_cast<int>(at % 4)]);
        const double lit = reference::linearFromSrgb(opaque.pixels.rgba[at] / 255.0);
        const double expected = hit ? 0.75 * background + 0.25 * lit : background;
        ASSERT_NEAR(reference::linearFromSrgb(clear.pixels.rgba[at] / 255.0), expected, 0.007) << at;
        compared += hit;
    }
    EXPECT_GT(compared, 3000);
}

/// Ambient light alone shows the base colour: the direction from the glyph's centre, in scanner axes, as an sRGB triple.
TEST_F(Layers, AreColouredByDirectionInScannerAxes) {
    const model::ShImage image = randomField({4, false}, {3, 3, 2}, 54, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 160, 120, 2);
    request.camera = cameraAround(image, {2, 1, 1}, true);
    request.scene.light.irradiance = 0;
    request.scene.light.ambient = 1;
    const model::Frame frame = draw(request);
    int hits = 0;
    for (std::size_t at = 0; at < frame.pixels.depth.size(); ++at) {
        if (frame.pixels.id[4 * at] < 0) continue;
        ++hits;
        const glm::ivec3 voxel(frame.pixels.id[4 * at + 1], frame.pixels.id[4 * at + 2], frame.pixels.id[4 * at + 3]);
        const glm::dvec3 position(frame.pixels.position[3 * at], frame.pixels.position[3 * at + 1],
                                  frame.pixels.position[3 * at + 2]);
        const glm::dvec3 offset = position + frame.info.position_origin_mm - voxelCentre(image, voxel);
        if (glm::length(offset) < 0.01) continue;
        const glm::dvec3 colour = 255.0 * glm::abs(glm::normalize(offset));
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(frame.pixels.rgba[4 * at + static_cast<std::size_t>(c)], colour[c], 1.0) << at;
    }
    EXPECT_GT(hits, 3000);
}

}  // namespace
}  // namespace radiata::test
