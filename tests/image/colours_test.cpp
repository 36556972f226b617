// Where the base colour of glyphs comes from, in whole pictures: each mode against its twin at every pixel, and what it costs.
#include <cmath>
#include <iostream>
#include <limits>

#include "image/fixture.h"
#include "math/colour_map.h"
#include "reference/colour_map.h"
#include "reference/shading.h"

namespace radiata::test {
namespace {

/// A field lit by constant ambient light only, so that a pixel's light is its base colour.
class Colours : public ImageTest {
protected:
    Colours() {
        store.add("field", image);
        request = requestOf("field", 96, 72, 2);
        request.camera = cameraAround(image, {1, 2, 3}, true);
        request.quality.samples = 1;
        request.scene.light.irradiance = 0;
        request.scene.light.ambient = 1;
        request.scene.background = {0.25F, 0.5F, 0.75F};
    }

    model::GlyphColour& colour() { return request.scene.layers[0].glyphs().colour; }

    model::ScalarImage scalars() const {
        model::ScalarImage made{image.size, image.voxel_to_world, {}, "values"};
        for (int i = 0; i < image.size.x * image.size.y * image.size.z; ++i) {
            made.values.push_back(static_cast<float>((7 * i) % 11) - 4);
        }
        made.values[5] = std::numeric_limits<float>::quiet_NaN();
        return made;
    }

    /// Largest |difference| of a channel from base(voxel, offset from the glyph's centre), in steps of 8 bits, over all hits.
    template <typename Base>
    double worstChannel(const model::Frame& frame, Base&& base) {
        double worst = 0;
        int hits = 0;
        for (std::size_t at = 0; at < frame.pixels.depth.size(); ++at) {
            if (frame.pixels.id[4 * at] < 0) continue;
            ++hits;
            const glm::ivec3 voxel(frame.pixels.id[4 * at + 1], frame.pixels.id[4 * at + 2], frame.pixels.id[4 * at + 3]);
            glm::dvec3 place = frame.info.position_origin_mm;
            for (int c = 0; c < 3; ++c)
                place[c] += static_cast<double>(frame.pixels.position[3 * at + static_cast<std::size_t>(c)]);
            const glm::dvec3 expected = base(voxel, place - voxelCentre(image, voxel));
            for (int c = 0; c < 3; ++c) {
                const double shown = frame.pixels.rgba[4 * at + static_cast<std::size_t>(c)];
                worst = std::max(worst, std::abs(shown - 255 * reference::srgbFromLinear(expected[c])));
            }
        }
        EXPECT_GT(hits, 500);
        return worst;
    }

    const model::ShImage image = randomField({4, false}, {3, 3, 2}, 71, obliqueAffine());
    model::FrameRequest request;
};

constexpr double kBound = 1.0;  // of 255: half a step for rounding, the rest for float

TEST_F(Colours, ByDirectionRadiusAndOneColourAreTheirTwins) {
    const auto by_direction = [](const glm::ivec3&, const glm::dvec3& offset) {
        const glm::dvec3 d = glm::abs(glm::normalize(offset));
        return glm::dvec3(reference::linearFromSrgb(d.x), reference::linearFromSrgb(d.y), reference::linearFromSrgb(d.z));
    };
    EXPECT_LE(worstChannel(draw(request), by_direction), kBound);
    colour().mode = model::ColourMode::kUniform;
    colour().uniform = {0.1F, 0.6F, 0.3F};
    EXPECT_LE(worstChannel(draw(request), [](const glm::ivec3&, const glm::dvec3&) { return glm::dvec3(0.1, 0.6, 0.3); }),
              kBound);
    colour() = {};
    colour().mode = model::ColourMode::kRadius;
    for (const bool own : {true, false}) {
        colour().map = own ? ColourMap::kInferno : ColourMap::kBlackRedYellow;
        if (own) colour().range = model::ColourRange{0.3F, 1.7F};
        if (!own) colour().range.reset();
        const model::Frame frame = draw(request);
        const model::GlyphColour& resolved = frame.info.request.scene.layers[0].glyphs().colour;
        ASSERT_TRUE(resolved.range) << "an open range is filled in";
        if (!own) {
            EXPECT_FLOAT_EQ(resolved.range->high, 2 * store.info("field").amplitude_typical);
        }
        EXPECT_LE(worstChannel(frame,
                               [&](const glm::ivec3&, const glm::dvec3& offset) {
                                   return reference::mappedColour(linearColourTable(resolved.map), glm::length(offset),
                                                                  resolved.range->low, resolved.range->high);
                               }),
                  kBound + 0.5);
    }
}

TEST_F(Colours, ByAScalarVolumeAreTheValuesAtTheGlyphsVoxels) {
    const model::ScalarImage values = scalars();
    store.add("values", values);
    colour().mode = model::ColourMode::kScalar;
    colour().image_id = "values";
    const auto base = [&](const model::Frame& frame) {
        const model::GlyphColour resolved = frame.info.request.scene.layers[0].glyphs().colour;
        return [&values, resolved](const glm::ivec3& voxel, const glm::dvec3&) {
            const float value = values.at(voxel);
            if (std::isnan(value)) return glm::dvec3(reference::linearFromSrgb(0.5));
            return reference::mappedColour(linearColourTable(resolved.map), value, resolved.range->low, resolved.range->high);
        };
    };
    const model::Frame whole = draw(request);
    EXPECT_EQ(whole.info.request.scene.layers[0].glyphs().colour.range, (model::ColourRange{-4, 6}));
    EXPECT_LE(worstChannel(whole, base(whole)), kBound);
    // The same volume with its first axis stored backwards, and a range that cuts both ends.
    model::ScalarImage reversed = values;
    reversed.voxel_to_world[3] += static_cast<double>(values.size.x - 1) * values.voxel_to_world[0];
    reversed.voxel_to_world[0] = -values.voxel_to_world[0];
    for (int k = 0; k < values.size.z; ++k) {
        for (int j = 0; j < values.size.y; ++j) {
            for (int i = 0; i < values.size.x; ++i) {
                reversed.values[static_cast<std::size_t>(i + values.size.x * (j + values.size.y * k))] =
                    values.at({values.size.x - 1 - i, j, k});
            }
        }
    }
    store.add("reversed", reversed);
    colour().image_id = "reversed";
    colour().range = model::ColourRange{-1, 2};
    const model::Frame cut = draw(request);
    EXPECT_LE(worstChannel(cut, base(cut)), kBound);
}

TEST_F(Colours, OfUnfitImagesAreRefused) {
    model::ScalarImage values = scalars();
    values.voxel_to_world[3] += glm::dvec4(1, 0, 0, 0);
    store.add("elsewhere", values);
    colour().mode = model::ColourMode::kScalar;
    for (const auto& [id, code] : {std::pair{"elsewhere", Code::kInvalidArgument}, std::pair{"field", Code::kInvalidArgument},
                                   std::pair{"nowhere", Code::kNotFound}, std::pair{"", Code::kInvalidArgument}}) {
        colour().image_id = id;
        EXPECT_EQ(codeOf([&] { draw(request); }), code) << id;
    }
    colour() = {};
    EXPECT_EQ(draw(request).info.request.scene.layers[0].glyphs().colour.mode, model::ColourMode::kDirection);
}

/// A map is 3 KiB and a value 4 bytes a glyph, and only scenes that use them have them.
TEST_F(Colours, CostNothingWhereTheyAreOff) {
    store.add("values", scalars());
    render::Target target;
    renderer.render(target, request, 0, 1);
    const std::uint64_t plain = device.allocatedBytes();
    colour().mode = model::ColourMode::kUniform;
    renderer.render(target, request, 0, 1);
    EXPECT_EQ(device.allocatedBytes(), plain) << "one colour needs no table";
    colour().mode = model::ColourMode::kRadius;
    renderer.render(target, request, 0, 1);
    const std::uint64_t mapped = device.allocatedBytes();
    EXPECT_GE(mapped, plain + 256 * 12);
    EXPECT_LE(mapped, plain + 256 * 12 + 4096);
    colour().mode = model::ColourMode::kScalar;
    colour().image_id = "values";
    renderer.render(target, request, 0, 1);
    EXPECT_GE(device.allocatedBytes(), mapped + image.voxels.size() * 4) << "the scene and its boxes are kept as they are";
    EXPECT_LE(device.allocatedBytes(), mapped + image.voxels.size() * 4 + 4096);
}

}  // namespace
}  // namespace radiata::test
