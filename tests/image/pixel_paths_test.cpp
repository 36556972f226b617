// Path tracing of isosurfaces' pixels: against path tracing in double and against the lattice, step by step, and what it costs.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <gmock/gmock.h>

#include "build/folded_ball.h"
#include "image/fixture.h"
#include "reference/path_tracer.h"
#include "reference/shading.h"

namespace radiata::test {
namespace {

class PixelPaths : public ImageTest {
protected:
    static constexpr int kSize = 32;
    PixelPaths() : image(foldedBall(kSize)) { store.add("ball", image); }

    static model::FrameRequest request() {
        model::FrameRequest request;
        request.width = 48;
        request.height = 40;
        request.quality.samples = 1;
        request.scene.layers.emplace_back().content =
            model::IsosurfaceLayer{.dataset_id = "ball", .isovalue = 30.0F, .colour = glm::vec3(0.7F)};
        model::Illumination& light = request.scene.light.illumination.emplace();
        light.method = model::IlluminationMethod::kPathTracing;
        light.sky = {glm::vec3(0.5F), glm::vec3(0.3F), {0, 0, 1}};
        light.bounces = 2;
        light.relative_error = 0.001F;
        light.samples_max = 256;
        request.camera.target_mm = {0, 0, 0};
        request.camera.eye_mm = {40, -70, 30};
        request.camera.up = {0, 0, 1};
        request.camera.perspective = false;
        request.camera.height_mm = 28;
        return request;
    }
    static model::Illumination& lightOf(model::FrameRequest& request) { return *request.scene.light.illumination; }
    static double radiance(const model::Frame& frame, std::size_t pixel) {
        return reference::linearFromSrgb(frame.pixels.rgba[4 * pixel] / 255.0);
    }
    /// Root mean square of a picture's differences to the traced one, relative to its mean.
    static double error(const model::Frame& frame, const model::Frame& traced) {
        double squares = 0, sum = 0;
        for (std::size_t i = 0; i < traced.pixels.depth.size(); ++i) {
            if (traced.pixels.id[4 * i] < 0) continue;
            squares += std::pow(radiance(traced, i) - radiance(frame, i), 2);
            sum += radiance(traced, i);
        }
        return std::sqrt(squares * static_cast<double>(traced.info.hit_pixels)) / sum;
    }
    static std::vector<std::string> passNames(const model::Frame& frame) {
        std::vector<std::string> names;
        for (const model::PassTime& pass : frame.info.passes) names.push_back(pass.name);
        return names;
    }

    model::ScalarImage image;
};

TEST_F(PixelPaths, AgreeWithTheReferencePixelByPixel) {
    const model::FrameRequest wanted = request();
    const model::Frame frame = draw(wanted);
    EXPECT_THAT(passNames(frame), testing::ElementsAre("isosurface trace", "pixel paths", "light"));
    const reference::ScalarField field(image);
    const glm::dmat4 to_grid = glm::inverse(image.voxel_to_world);
    const reference::Lights lights{[](const glm::dvec3& d) { return 0.5 + 0.3 * d.z; }, {}};
    int hits = 0, far = 0;
    double off = 0, mean = 0;
    for (std::size_t i = 0; i < frame.pixels.depth.size(); i += 9) {
        if (frame.pixels.id[4 * i] < 0) continue;
        const glm::dvec3 place =
            frame.info.position_origin_mm +
            glm::dvec3(frame.pixels.position[3 * i], frame.pixels.position[3 * i + 1], frame.pixels.position[3 * i + 2]);
        const auto truth =
            reference::irradianceByBounce(field, 30, glm::dvec3(to_grid * glm::dvec4(place, 1)), lights, 2, 400, i);
        double expected = 0, variance = 0, weight = 0.7 / 3.14159265358979;
        for (std::size_t k = 0; k < truth.mean.size(); ++k, weight *= 0.7) {
            expected += weight * truth.mean[k];
            variance += std::pow(weight * truth.standard_error[k], 2);
        }
        // 256 points of low discrepancy have about a third of the error of as many random ones; and 8 bits.
        const double error = std::sqrt(variance * (1 + 400.0 / 256 / 9) + 0.003 * 0.003);
        const double apart = (radiance(frame, i) - expected) / error;
        ++hits;
        far += std::abs(apart) > 3;
        off += radiance(frame, i) - expected;
        mean += expected;
    }
    std::printf("%d pixels, %d beyond 3 standard errors, mean off by %.2g %%\n", hits, far, 100 * off / mean);
    EXPECT_GT(hits, 80);
    EXPECT_LE(far, 1 + hits / 50);
    EXPECT_LT(std::abs(off / mean), 0.01);
    const model::IlluminationInfo& info = *frame.info.illumination;
    EXPECT_EQ(info.texels, 48u * 40);
    EXPECT_EQ(info.texels_needed, frame.info.hit_pixels);
    EXPECT_EQ(info.texels_done, info.texels_needed);
    EXPECT_LE(info.samples, 256 * info.texels_needed);
    EXPECT_GT(info.samples, 128 * info.texels_needed) << "a few pixels are exact to a thousandth before";
    EXPECT_GT(info.mean_error, 0.0005);
    EXPECT_LT(info.mean_error, 0.05);
}

TEST_F(PixelPaths, AreWhatTheLatticeInterpolatesTheNearerTheFinerItIsAndNearestAtRest) {
    model::FrameRequest wanted = request();
    lightOf(wanted).suns = {{{0.7, -0.6, 0.6}, 18, glm::vec3(0.8F)}};
    const model::Frame traced = draw(wanted);
    lightOf(wanted).method = model::IlluminationMethod::kLattice;
    lightOf(wanted).samples_max = 64;
    const auto errorOf = [&](model::LatticeResolution resolution, bool project) {
        lightOf(wanted).resolution = resolution;
        lightOf(wanted).project = project;
        return error(draw(wanted), traced);
    };
    const double eighth = errorOf(model::LatticeResolution::kEighth, false),
                 one = errorOf(model::LatticeResolution::kOne, false), eight = errorOf(model::LatticeResolution::kEight, false),
                 rest = errorOf(model::LatticeResolution::kOne, true);
    std::printf("differences %.2g, %.2g and %.2g %% by resolution, %.2g %% at rest\n", 100 * eighth, 100 * one, 100 * eight,
                100 * rest);
    EXPECT_LT(one, 0.12);
    EXPECT_LT(one, 0.8 * eighth);
    EXPECT_LT(eight, 0.9 * one);
    EXPECT_LT(rest, 0.65 * one);
}

// As tissues do in measured images: the smoothed gradient says little of how values change there.
TEST_F(PixelPaths, AreNearTheTexelsAtRestWhereValuesJumpWithinAVoxel) {
    model::ScalarImage steep = foldedBall(kSize);
    for (float& value : steep.values) value = std::clamp(30 + 8 * (value - 30), 0.0F, 100.0F);
    store.add("steep", steep);
    model::FrameRequest wanted = request();
    wanted.scene.layers[0].surface().dataset_id = "steep";
    for (const float degrees : {18.0F, 5.0F}) {
        lightOf(wanted).suns = {{{0.7, -0.6, 0.6}, degrees, glm::vec3(0.8F)}};
        lightOf(wanted).method = model::IlluminationMethod::kPathTracing;
        lightOf(wanted).samples_max = 256;
        const model::Frame traced = draw(wanted);
        lightOf(wanted).method = model::IlluminationMethod::kLattice;
        lightOf(wanted).samples_max = 64;
        lightOf(wanted).project = true;
        const double rest = error(draw(wanted), traced);
        lightOf(wanted).project = false;
        const double own = error(draw(wanted), traced);
        std::printf("sun of %g degrees: %.2g %% on their own level sets, %.2g %% at rest\n", double{degrees}, 100 * own,
                    100 * rest);
        EXPECT_LT(rest, 0.5 * own);
    }
}

/// A picture of one sample may be worked on slice by slice: other pictures have their turn meanwhile, and it is the same in the
/// end.
TEST_F(PixelPaths, AndTexelsOfOneSampleGrowInSlices) {
    model::FrameRequest wanted = request();
    wanted.quality.samples = 1;
    lightOf(wanted).relative_error = 0.01F;
    lightOf(wanted).samples_max = 1024;
    model::Outputs outputs;
    outputs.depth = true;
    for (const model::IlluminationMethod method :
         {model::IlluminationMethod::kPathTracing, model::IlluminationMethod::kLattice}) {
        lightOf(wanted).method = method;
        render::Target target;
        model::Frame frame = renderer.render(target, wanted, 0, 0, outputs);
        EXPECT_EQ(frame.pixels.depth.size(), static_cast<std::size_t>(wanted.width) * static_cast<std::size_t>(wanted.height));
        int slices = 1;
        for (; frame.info.samples < 1 && slices < 500; ++slices) {
            model::FrameRequest other = wanted;
            other.camera.eye_mm += glm::dvec3(slices, 0, 0);
            lightOf(other).samples_max = 4;
            if (slices < 4) draw(other);
            frame = renderer.render(target, wanted, 0, 0);
        }
        EXPECT_EQ(frame.info.samples, 1);
        EXPECT_GT(slices, 1) << "too short a picture to say anything";
        EXPECT_EQ(frame.pixels.rgba, draw(wanted).pixels.rgba);
    }
}

TEST_F(PixelPaths, StopAtTheErrorThatWasAskedForAndGrowStepByStep) {
    model::FrameRequest wanted = request();
    wanted.quality.samples = 2;
    lightOf(wanted).relative_error = 0.1F;
    lightOf(wanted).samples_max = 1024;
    render::Target target;
    const model::Frame first = renderer.render(target, wanted, 0, 1);
    EXPECT_EQ(first.info.illumination->samples, 4 * first.info.illumination->texels_needed) << "four paths each";
    model::Frame frame = first;
    for (int steps = 0; frame.info.samples < 2; ++steps) {
        frame = renderer.render(target, wanted, frame.info.samples, 2 - frame.info.samples);
        ASSERT_LT(steps, 500);
    }
    const model::Frame whole = renderer.renderAll(wanted);
    EXPECT_EQ(frame.pixels.rgba, whole.pixels.rgba) << "however it came about";
    EXPECT_EQ(whole.info.illumination->texels_done, whole.info.illumination->texels_needed);
    EXPECT_LT(whole.info.illumination->p95_error, 0.1 * 1.01);
    EXPECT_LT(whole.info.illumination->samples, 512 * whole.info.illumination->texels_needed / 4)
        << "most pixels are done early";
}

TEST_F(PixelPaths, KeepNothingAndCostOthersNothing) {
    model::FrameRequest local = request();
    local.scene.light.illumination.reset();
    render::Target target;
    renderer.render(target, local, 0, 1);
    const std::uint64_t bytes = device.allocatedBytes();
    model::FrameRequest wanted = request();
    lightOf(wanted).samples_max = 4;
    renderer.render(target, wanted, 0, 1);
    // 36 bytes of paths and 12 of light a pixel with room to grow, and the light.
    EXPECT_LE(device.allocatedBytes(), bytes + 48 * 40 * 48 * 5 / 4 + 8192);
    wanted.scene.layers[0].surface().shading = model::SurfaceShading::kLambert;
    EXPECT_FALSE(renderer.render(target, wanted, 0, 1).info.illumination) << "lit locally";
}

}  // namespace
}  // namespace radiata::test
