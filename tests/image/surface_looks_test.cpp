// Isosurfaces with a look of their own: local shadings, fog, colours by another volume, and several volumes in one picture.
#include <cmath>

#include <gmock/gmock.h>

#include "build/folded_ball.h"
#include "image/fixture.h"
#include "reference/camera_rays.h"
#include "reference/colour_map.h"
#include "reference/phong.h"
#include "reference/shading.h"

namespace radiata::test {
namespace {

class SurfaceLooks : public ImageTest {
protected:
    static constexpr int kWidth = 64, kHeight = 48;

    static model::FrameRequest request() {
        model::FrameRequest request;
        request.width = kWidth;
        request.height = kHeight;
        request.quality.samples = 1;
        request.scene.background = glm::vec3(0.1F, 0.2F, 0.4F);
        request.scene.layers.emplace_back().content =
            model::IsosurfaceLayer{.dataset_id = "ball", .isovalue = 30.0F, .colour = {0.5F, 0.4F, 0.3F}};
        request.scene.light.direction_world = glm::dvec3(1, -0.4, 0.8);
        request.camera.target_mm = {0, 0, 0};
        request.camera.eye_mm = {28.5, -61.5, 18.5};
        request.camera.up = {0, 0, 1};
        request.camera.perspective = true;
        request.camera.field_of_view_deg = 26;
        return request;
    }
    static model::IsosurfaceLayer& surfaceOf(model::FrameRequest& request) { return request.scene.layers[0].surface(); }
    static double linear(const model::Frame& frame, std::size_t pixel, int channel) {
        return reference::linearFromSrgb(frame.pixels.rgba[4 * pixel + static_cast<std::size_t>(channel)] / 255.0);
    }
    static glm::dvec3 normalAt(const model::Frame& frame, std::size_t i) {
        return {frame.pixels.normal[3 * i], frame.pixels.normal[3 * i + 1], frame.pixels.normal[3 * i + 2]};
    }
    static glm::dvec3 placeAt(const model::Frame& frame, std::size_t i) {
        return frame.info.position_origin_mm +
               glm::dvec3(frame.pixels.position[3 * i], frame.pixels.position[3 * i + 1], frame.pixels.position[3 * i + 2]);
    }
    /// A volume of half the ball's voxels, turned and off its grid, whose values are linear in the world.
    static model::ScalarImage ramp() {
        model::ScalarImage image;
        image.size = {14, 15, 16};
        const double turn = 0.4;
        const glm::dmat3 axes(1.8 * std::cos(turn), 1.8 * std::sin(turn), 0, -1.8 * std::sin(turn), 1.8 * std::cos(turn), 0, 0,
                              0, 1.7);
        image.voxel_to_world = glm::dmat4(axes);
        image.voxel_to_world[3] = glm::dvec4(glm::dvec3(14, -6, 3) - axes * glm::dvec3(6.5, 7, 7.5), 1);
        for (int n = 0; n < 14 * 15 * 16; ++n) {
            const glm::dvec4 voxel(n % 14, n / 14 % 15, n / (14 * 15), 1);
            image.values.push_back(static_cast<float>(rampValue(glm::dvec3(image.voxel_to_world * voxel))));
        }
        image.source = "ramp";
        return image;
    }
    static double rampValue(const glm::dvec3& p) { return 3 + 0.2 * p.x - 0.1 * p.y + 0.3 * p.z; }
};

/// A step of 255 in sRGB is at most 0.009 of linear light.
constexpr double kStep = 0.0075;

TEST_F(SurfaceLooks, LambertAndPhongAreTheReferences) {
    store.add("ball", foldedBall(24));
    model::FrameRequest wanted = request();
    const glm::dvec3 light = glm::normalize(*wanted.scene.light.direction_world), base(0.5, 0.4, 0.3);
    wanted.scene.light.irradiance = 1.5F;
    for (const bool phong : {false, true}) {
        surfaceOf(wanted).shading = phong ? model::SurfaceShading::kPhong : model::SurfaceShading::kLambert;
        const model::Frame frame = draw(wanted);
        int hits = 0;
        for (std::size_t i = 0; i < frame.pixels.depth.size(); ++i) {
            if (frame.pixels.id[4 * i] < 0) continue;
            ++hits;
            const glm::dvec3 n = glm::normalize(normalAt(frame, i));
            const glm::dvec3 viewer =
                -reference::cameraRay(wanted.camera, kWidth, kHeight, static_cast<double>(i % kWidth) + 0.5,
                                      static_cast<double>(i / kWidth) + 0.5)
                     .direction;
            const glm::dvec3 reflected =
                phong ? reference::phongReflection(base, n, viewer, light) : reference::lambertReflection(base, n, light);
            const glm::dvec3 expected = 1.5 * reflected + 0.35 * reference::varyingAmbient(n, light) * base;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(linear(frame, i, c), std::min(expected[c], 1.0), kStep) << i;
        }
        EXPECT_GT(hits, 250);
    }
}

TEST_F(SurfaceLooks, FogGrowsFromTheNearEndOfTheBoxToTheFar) {
    store.add("ball", foldedBall(24));
    model::FrameRequest wanted = request();
    surfaceOf(wanted).shading = model::SurfaceShading::kLambert;
    const model::Frame clear = draw(wanted);
    surfaceOf(wanted).fog = 0.8F;
    const model::Frame foggy = draw(wanted);
    const glm::dvec3 forward = glm::normalize(wanted.camera.target_mm - wanted.camera.eye_mm);
    double near = 1e30, far = -1e30;
    for (int corner = 0; corner < 8; ++corner) {
        const double along = glm::dot(23.0 * glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2) - 11.5, forward);
        near = std::min(near, along);
        far = std::max(far, along);
    }
    for (std::size_t i = 0; i < clear.pixels.depth.size(); ++i) {
        if (clear.pixels.id[4 * i] < 0) continue;
        const double share = 0.8 * (glm::dot(placeAt(clear, i), forward) - near) / (far - near);
        for (int c = 0; c < 3; ++c) {
            const double background = wanted.scene.background[c];
            EXPECT_NEAR(linear(foggy, i, c), (1 - share) * linear(clear, i, c) + share * background, 2 * kStep);
        }
    }
    // Everything fades, whatever lights it.
    surfaceOf(wanted).shading = model::SurfaceShading::kScene;
    surfaceOf(wanted).fog = 1.0F;
    const model::Frame local = draw(wanted);
    wanted.scene.light.illumination.emplace().samples_max = 4;
    const model::Frame global = draw(wanted);
    for (const model::Frame* frame : {&local, &global}) {
        double difference = 0;
        for (std::size_t i = 0; i < clear.pixels.depth.size(); ++i) {
            difference += std::abs(frame->pixels.rgba[4 * i] - clear.pixels.rgba[4 * i]);
        }
        EXPECT_GT(difference, 1000);
    }
}

TEST_F(SurfaceLooks, ColoursAreThoseOfAnotherVolumeOnAnotherGrid) {
    store.add("ball", foldedBall(24));
    const model::ScalarImage image = ramp();
    store.add("ramp", image);
    model::FrameRequest wanted = request();
    wanted.scene.light.irradiance = 0;
    wanted.scene.light.ambient = 1;
    surfaceOf(wanted).colour_by = model::VolumeColour{"ramp", ColourMap::kInferno, model::ColourRange{0, 12}};
    for (const float opacity : {1.0F, 0.999F}) {
        wanted.scene.layers[0].opacity = opacity;
        model::FrameRequest opaque = wanted;
        opaque.scene.layers[0].opacity = 1;
        const model::Frame places = draw(opaque), frame = draw(wanted);
        const glm::dmat4 to_grid = glm::inverse(image.voxel_to_world);
        int inside = 0, outside = 0;
        for (std::size_t i = 0; i < places.pixels.depth.size(); ++i) {
            if (places.pixels.id[4 * i] < 0) continue;
            const glm::dvec3 place = placeAt(places, i), grid(to_grid * glm::dvec4(place, 1));
            const glm::dvec3 off = glm::max(glm::abs(grid - glm::dvec3(6.5, 7, 7.5)) - glm::dvec3(6.5, 7, 7.5), glm::dvec3(-1));
            const double apart = std::max(off.x, std::max(off.y, off.z));
            if (std::abs(apart) < 1e-3) continue;
            (apart < 0 ? inside : outside) += 1;
            const glm::dvec3 expected =
                apart < 0 ? reference::mappedColour(linearColourTable(ColourMap::kInferno), rampValue(place), 0, 12)
                          : glm::dvec3(0.214);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(linear(frame, i, c), expected[c], 2 * kStep) << i;
        }
        EXPECT_GT(inside, 50);
        EXPECT_GT(outside, 50);
    }
    // Left open, the range is that of the colouring volume.
    surfaceOf(wanted).colour_by->range.reset();
    const auto range = *draw(wanted).info.request.scene.layers[0].surface().colour_by->range;
    EXPECT_EQ(range.low, *std::ranges::min_element(image.values));
    EXPECT_EQ(range.high, *std::ranges::max_element(image.values));
    surfaceOf(wanted).colour_by->image_id = "nothing";
    EXPECT_EQ(codeOf([&] { draw(wanted); }), Code::kNotFound);
    surfaceOf(wanted).colour_by->image_id = "";
    EXPECT_EQ(codeOf([&] { draw(wanted); }), Code::kInvalidArgument);
}

TEST_F(SurfaceLooks, CostNothingWhereTheyAreNotAskedFor) {
    store.add("ball", foldedBall(24));
    render::Target target;
    const model::Frame plain = renderer.render(target, request(), 0, 1);
    const std::uint64_t bytes = device.allocatedBytes();
    const std::size_t pipelines = renderer.pipelineCount();
    model::FrameRequest wanted = request();
    surfaceOf(wanted).shading = model::SurfaceShading::kPhong;
    // Lit locally, though the scene has global light.
    wanted.scene.light.illumination.emplace();
    const model::Frame own = renderer.render(target, wanted, 0, 1);
    EXPECT_EQ(own.info.passes.size(), plain.info.passes.size());
    EXPECT_FALSE(own.info.illumination);
    EXPECT_EQ(renderer.pipelineCount(), pipelines + 1) << "another light pass";
    EXPECT_GT(device.allocatedBytes(), bytes);
    EXPECT_LE(device.allocatedBytes(), bytes + 4096) << "a page of looks";
}

TEST_F(SurfaceLooks, SeveralVolumesStandTogetherEachInItsOwnLight) {
    model::ScalarImage other = ramp();
    for (std::size_t n = 0; n < other.values.size(); ++n) {
        const glm::dvec3 voxel(static_cast<double>(n % 14), static_cast<double>(n / 14 % 15), static_cast<double>(n / 210));
        other.values[n] = static_cast<float>(7 - glm::length(voxel - glm::dvec3(6.5, 7, 7.5)));
    }
    store.add("ball", foldedBall(24));
    store.add("other", other);
    model::FrameRequest both = request();
    const model::FrameRequest ball = both;
    both.scene.layers.emplace_back().content =
        model::IsosurfaceLayer{.dataset_id = "other", .isovalue = 4.0F, .colour = glm::vec3(0.6F)};
    model::FrameRequest alone = both;
    alone.scene.layers.erase(alone.scene.layers.begin());
    for (const bool global : {false, true}) {
        for (model::FrameRequest* one : {&both, &alone}) {
            if (!global) continue;
            model::Illumination& light = one->scene.light.illumination.emplace();
            light.relative_error = 0.1F;
            light.samples_max = 64;
        }
        model::FrameRequest lit_ball = ball;
        lit_ball.scene.light = both.scene.light;
        const model::Frame a = draw(lit_ball), b = draw(alone), ab = draw(both);
        int from_a = 0, from_b = 0;
        for (std::size_t i = 0; i < a.pixels.depth.size(); ++i) {
            const double depth_a = static_cast<double>(a.pixels.depth[i]) + a.info.depth_offset_mm;
            const double depth_b = static_cast<double>(b.pixels.depth[i]) + b.info.depth_offset_mm;
            if (std::min(depth_a, depth_b) > 1e30 || std::abs(depth_a - depth_b) < 1e-3) continue;
            const bool first = depth_a < depth_b;
            (first ? from_a : from_b) += 1;
            ASSERT_EQ(ab.pixels.id[4 * i], first ? 0 : 1);
            const model::Frame& shown = first ? a : b;
            // Texels end by their own error; where one picture needs more of them, their last samples may differ.
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_NEAR(ab.pixels.rgba[4 * i + c], shown.pixels.rgba[4 * i + c], global ? 3 : 1) << i;
            }
        }
        EXPECT_GT(from_a, 150);
        EXPECT_GT(from_b, 50);
    }
}

}  // namespace
}  // namespace radiata::test
