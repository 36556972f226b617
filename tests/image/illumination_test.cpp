// Global light in pictures: what is computed, what is kept when something changes, what is shown meanwhile, and what is
// refused.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <unistd.h>

#include <gmock/gmock.h>

#include "build/folded_ball.h"
#include "image/fixture.h"
#include "io/nifti_write.h"
#include "reference/path_tracer.h"
#include "render/frame/saved_files.h"
#include "store/saved_lattices.h"
#include "store/volume_dataset.h"

namespace radiata::test {
namespace {

class GlobalLight : public ImageTest {
protected:
    static model::ScalarImage ball(int size, double radius) {
        model::ScalarImage image;
        image.size = glm::ivec3(size);
        image.source = "ball";
        const glm::dvec3 centre(0.5 * (size - 1));
        for (int z = 0; z < size; ++z) {
            for (int y = 0; y < size; ++y) {
                for (int x = 0; x < size; ++x) {
                    image.values.push_back(static_cast<float>(radius - glm::length(glm::dvec3(x, y, z) - centre)));
                }
            }
        }
        image.voxel_to_world[3] = glm::dvec4(-centre, 1);
        return image;
    }
    static model::FrameRequest request(float isovalue, int width = 64, int height = 48) {
        model::FrameRequest request;
        request.width = width;
        request.height = height;
        request.quality.samples = 2;
        request.scene.layers.emplace_back().content =
            model::IsosurfaceLayer{.dataset_id = "volume", .isovalue = isovalue, .colour = glm::vec3(0.7F)};
        request.scene.light.illumination = model::Illumination{};
        request.scene.light.illumination->relative_error = 0.1F;
        request.scene.light.illumination->samples_max = 64;
        request.camera.target_mm = {0, 0, 0};
        request.camera.eye_mm = {40, -70, 30};
        request.camera.up = {0, 0, 1};
        request.camera.perspective = false;
        request.camera.height_mm = 24;
        return request;
    }
    static model::Illumination& lightOf(model::FrameRequest& request) { return *request.scene.light.illumination; }
    static std::vector<std::string> passNames(const model::Frame& frame) {
        std::vector<std::string> names;
        for (const model::PassTime& pass : frame.info.passes) names.push_back(pass.name);
        return names;
    }
    /// Linear radiance of a pixel's red.
    static double radiance(const model::Frame& frame, std::size_t pixel) {
        const double v = frame.pixels.rgba[4 * pixel] / 255.0;
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    }
};

TEST_F(GlobalLight, CostsNothingWhereItIsNotAskedFor) {
    store.add("volume", foldedBall(24));
    model::FrameRequest local = request(30);
    local.scene.light.illumination.reset();
    const model::Frame frame = renderer.renderAll(local);
    EXPECT_THAT(passNames(frame), testing::ElementsAre("isosurface trace", "light", "resolve"));
    EXPECT_FALSE(frame.info.illumination);
    const std::size_t pipelines = renderer.pipelineCount();
    renderer.renderAll(request(30));
    // Two ways to request, collecting, lighting, gathering for first and later samples, and another light pass for each.
    EXPECT_EQ(renderer.pipelineCount(), pipelines + 8);
}

TEST_F(GlobalLight, OfAConvexSurfaceUnderAnEvenSkyIsEven) {
    store.add("volume", ball(24, 9));
    model::FrameRequest wanted = request(0);
    lightOf(wanted).sky.radiance = glm::vec3(0.8F);
    for (const bool project : {false, true}) {
        for (const model::TexelPayload payload : {model::TexelPayload::kIrradiance, model::TexelPayload::kTransfer}) {
            lightOf(wanted).project = project;
            lightOf(wanted).payload = payload;
            const model::Frame frame = renderer.renderAll(wanted, everything());
            int hits = 0;
            for (std::size_t i = 0; i < 64 * 48; ++i) {
                // Pixels at the outline are partly background.
                const bool inside = frame.pixels.id[4 * i] == 0 && frame.pixels.normal[3 * i] * 0.46 +
                                                                           frame.pixels.normal[3 * i + 1] * -0.81 +
                                                                           frame.pixels.normal[3 * i + 2] * 0.35 >
                                                                       0.5;
                if (!inside) continue;
                ++hits;
                // One step of 255 in sRGB is 0.009 of radiance here; trilinear spheres have dents of some hundredths of a
                // voxel.
                EXPECT_NEAR(radiance(frame, i), 0.7 * 0.8, 0.02) << i;
            }
            EXPECT_GT(hits, 700);
        }
    }
}

TEST_F(GlobalLight, KnowsWorldDirectionsOnShearedAndMirroredGrids) {
    // A ball of 9 mm in the world. Under the sky a + g (d . up) a convex surface with the normal n has the radiance
    // albedo (a + 2/3 g (n . up)), whatever its grid.
    for (const bool mirrored : {false, true}) {
        model::ScalarImage image;
        image.size = glm::ivec3(26);
        image.source = "ball";
        image.voxel_to_world[0] = {mirrored ? -1.1 : 1.1, 0.3, -0.2, 0};
        image.voxel_to_world[1] = {-0.4, 1.2, 0.5, 0};
        image.voxel_to_world[2] = {0.3, -0.3, 1.3, 0};
        image.voxel_to_world[3] = glm::dvec4(-glm::dmat3(image.voxel_to_world) * glm::dvec3(12.5), 1);
        for (int n = 0; n < 26 * 26 * 26; ++n) {
            const glm::dvec4 voxel(n % 26, n / 26 % 26, n / 676, 1);
            image.values.push_back(static_cast<float>(9 - glm::length(glm::dvec3(image.voxel_to_world * voxel))));
        }
        const std::string id = mirrored ? "mirrored" : "sheared";
        store.add(id, image);
        model::FrameRequest wanted = request(0);
        wanted.scene.layers[0].surface().dataset_id = id;
        const glm::dvec3 up = glm::normalize(glm::dvec3(1, -1, 2));
        lightOf(wanted).sky = {glm::vec3(0.6F), glm::vec3(0.5F), up};
        lightOf(wanted).relative_error = 0.03F;
        lightOf(wanted).samples_max = 256;
        for (const model::TexelPayload payload : {model::TexelPayload::kIrradiance, model::TexelPayload::kTransfer}) {
            lightOf(wanted).payload = payload;
            const model::Frame frame = renderer.renderAll(wanted, everything());
            int hits = 0;
            double off = 0;
            for (std::size_t i = 0; i < 64 * 48; ++i) {
                const glm::dvec3 n(frame.pixels.normal[3 * i], frame.pixels.normal[3 * i + 1], frame.pixels.normal[3 * i + 2]);
                // Pixels at the outline are partly background.
                const glm::dvec3 towards = glm::normalize(wanted.camera.eye_mm);
                if (frame.pixels.id[4 * i] != 0 || glm::dot(n, towards) < 0.5) continue;
                ++hits;
                const double error = radiance(frame, i) - 0.7 * (0.6 + 2.0 / 3 * 0.5 * glm::dot(n, up));
                off += error;
                EXPECT_NEAR(error, 0, 0.04) << id << " " << i;
            }
            EXPECT_GT(hits, 700);
            EXPECT_NEAR(off / hits, 0, 0.01);
        }
    }
}

TEST_F(GlobalLight, LooksOnlyAtWhatIsSeenAndReachesTheErrorThatWasAskedFor) {
    store.add("volume", foldedBall(32));
    model::FrameRequest wanted = request(30);
    lightOf(wanted).samples_max = 1024;
    const model::Frame frame = renderer.renderAll(wanted);
    const model::IlluminationInfo& info = *frame.info.illumination;
    EXPECT_EQ(info.texels, 32u * 32 * 32);
    EXPECT_GT(info.texels_needed, 500u);
    EXPECT_LT(info.texels_needed, info.texels / 4);
    EXPECT_EQ(info.texels_done, info.texels_needed);
    EXPECT_LE(info.p95_error, 0.1 * 1.01);
    EXPECT_GT(info.mean_error, 0);
    EXPECT_EQ(info.bricks_left_out, 0u);
    EXPECT_TRUE(info.projected);
    // Of both samples of the picture; the second one's own texels are few.
    EXPECT_GE(info.samples, 16 * info.texels_needed);
    EXPECT_GT(info.seconds, 0);
    EXPECT_EQ(info.texels_out_of_samples, 0u);

    // Drawn again, the same view asks for nothing, and knows what it needs.
    wanted.quality.samples = 1;
    const model::Frame one = renderer.renderAll(wanted), again = renderer.renderAll(wanted);
    EXPECT_THAT(passNames(one), testing::Contains("illumination request"));
    EXPECT_THAT(passNames(again), testing::ElementsAre("isosurface trace", "global light", "light"));
    EXPECT_EQ(again.pixels.rgba, one.pixels.rgba);
    EXPECT_EQ(again.info.illumination->texels_done, one.info.illumination->texels_needed);
    EXPECT_EQ(again.info.illumination->samples, 0u);
    // What takes its light away asks anew.
    lightOf(wanted).sky.radiance = glm::vec3(0.3F);
    EXPECT_GT(renderer.renderAll(wanted).info.illumination->samples, 0u);
}

TEST_F(GlobalLight, TableOfWhatAChangeKeeps) {
    // docs/architecture.md, "Global light": the camera and the isovalue keep texels, light keeps transfer.
    store.add("volume", foldedBall(24));
    model::FrameRequest first = request(30);
    lightOf(first).project = false;
    const auto samplesOf = [&](const model::FrameRequest& wanted) {
        return renderer.renderAll(wanted).info.illumination->samples;
    };
    EXPECT_GT(samplesOf(first), 0u);
    EXPECT_EQ(samplesOf(first), 0u) << "the same again";

    model::FrameRequest turned = first;
    turned.camera.eye_mm = {60, -40, 25};
    EXPECT_GT(samplesOf(turned), 0u);
    EXPECT_EQ(samplesOf(first), 0u) << "another camera keeps texels";

    model::FrameRequest inner = request(45);
    lightOf(inner).project = false;
    EXPECT_GT(samplesOf(inner), 0u);
    EXPECT_EQ(samplesOf(first), 0u) << "so does another isovalue";

    model::FrameRequest bright = first;
    lightOf(bright).sky.radiance = glm::vec3(0.4F);
    EXPECT_GT(samplesOf(bright), 0u) << "irradiance is of one light";

    model::FrameRequest transfer = first;
    lightOf(transfer).payload = model::TexelPayload::kTransfer;
    EXPECT_GT(samplesOf(transfer), 0u);
    const model::Frame before = renderer.renderAll(transfer);
    lightOf(transfer).sky = {glm::vec3(0.4F), glm::vec3(0.3F), {1, 0, 0}};
    lightOf(transfer).rotation = {1, 0, 1, 0};
    // Texels stop by the error of what they show, so another light may ask a few of them for more.
    lightOf(transfer).relative_error = 1;
    const model::Frame after = renderer.renderAll(transfer);
    EXPECT_EQ(after.info.illumination->samples, 0u) << "transfer is of any light";
    EXPECT_NE(before.pixels.rgba, after.pixels.rgba);

    model::FrameRequest coloured = transfer;
    coloured.scene.layers[0].surface().colour = glm::vec3(0.2F, 0.5F, 0.6F);
    EXPECT_EQ(samplesOf(coloured), 0u) << "bounces are kept apart, so the surface's colour may change";
}

TEST_F(GlobalLight, ShowsWhatThereIsAndRefinesStepByStep) {
    store.add("volume", foldedBall(32));
    model::FrameRequest wanted = request(30);
    lightOf(wanted).relative_error = 0.03F;
    lightOf(wanted).samples_max = 256;
    render::Target target;
    const model::Frame coarse = renderer.render(target, wanted, 0, 1);
    EXPECT_EQ(coarse.info.samples, 1);
    EXPECT_EQ(coarse.info.illumination->samples, 4 * coarse.info.illumination->texels_needed) << "four samples each";
    EXPECT_FALSE(coarse.info.illumination->projected);
    int steps = 0;
    model::Frame frame = coarse;
    while (frame.info.samples < 2) {
        frame = renderer.render(target, wanted, frame.info.samples, 2 - frame.info.samples);
        ASSERT_LT(++steps, 500);
        EXPECT_EQ(frame.info.state == model::FrameState::kRefining, frame.info.samples < 2);
    }
    EXPECT_EQ(frame.info.state, model::FrameState::kConverged);
    EXPECT_EQ(frame.info.illumination->texels_done, frame.info.illumination->texels_needed);
    EXPECT_EQ(frame.pixels.rgba, renderer.renderAll(wanted).pixels.rgba) << "however it came about";
}

TEST_F(GlobalLight, BeyondTheBudgetIsLocalAndSaysSo) {
    store.add("volume", foldedBall(24));
    model::FrameRequest wanted = request(30), local = wanted;
    local.scene.light.illumination.reset();
    lightOf(wanted).budget_mib = 0.001F;
    const model::Frame frame = renderer.renderAll(wanted);
    EXPECT_GT(frame.info.illumination->bricks_left_out, 0u);
    EXPECT_EQ(frame.info.illumination->texels_needed, 0u);
    EXPECT_EQ(frame.pixels.rgba, renderer.renderAll(local).pixels.rgba);
    // Room for a part: bricks that were wanted longest ago go first, and the picture is still there.
    lightOf(wanted).budget_mib = 0.2F;
    for (const double x : {40.0, -40.0, 40.0}) {
        wanted.camera.eye_mm.x = x;
        const model::Frame part = renderer.renderAll(wanted);
        EXPECT_GT(part.info.illumination->texels_needed, 0u);
        EXPECT_LE(part.info.illumination->bytes, 0.2 * 1048576 + 8 * 216);
    }
}

TEST_F(GlobalLight, EveryWayToInterpolateIsNearToTheOthers) {
    store.add("volume", ball(24, 9));
    model::FrameRequest wanted = request(0.3F);
    lightOf(wanted).sky = {glm::vec3(0.6F), glm::vec3(0.5F), {0, 0, 1}};
    const model::Frame trilinear = renderer.renderAll(wanted);
    for (const auto other :
         {model::TexelInterpolation::kOwnIsovalue, model::TexelInterpolation::kNearest, model::TexelInterpolation::kTricubic}) {
        lightOf(wanted).interpolation = other;
        const model::Frame frame = renderer.renderAll(wanted);
        double difference = 0;
        int hits = 0;
        for (std::size_t i = 0; i < 64 * 48; ++i) {
            if (trilinear.pixels.rgba[4 * i] == 0) continue;
            ++hits;
            difference += std::abs(radiance(trilinear, i) - radiance(frame, i));
        }
        EXPECT_LT(difference / hits, 0.03) << static_cast<int>(other);
        EXPECT_NE(frame.pixels.rgba, trilinear.pixels.rgba);
    }
    for (const auto resolution : {model::LatticeResolution::kEighth, model::LatticeResolution::kEight}) {
        lightOf(wanted).interpolation = model::TexelInterpolation::kTrilinear;
        lightOf(wanted).resolution = resolution;
        const model::Frame frame = renderer.renderAll(wanted);
        const std::uint64_t side = resolution == model::LatticeResolution::kEight ? 47 : 13;
        EXPECT_EQ(frame.info.illumination->texels, side * side * side);
    }
}

TEST_F(GlobalLight, OfAnEvenMapIsThatOfAnEvenSky) {
    store.add("volume", foldedBall(24));
    store.add("sky", model::EnvironmentMap{8, 4, std::vector<glm::vec3>(32, glm::vec3(0.4F)), "made", {}});
    for (const model::TexelPayload payload : {model::TexelPayload::kIrradiance, model::TexelPayload::kTransfer}) {
        model::FrameRequest sky = request(30), map = sky;
        lightOf(sky).payload = lightOf(map).payload = payload;
        lightOf(map).environment = model::EnvironmentLight{"sky", 2};
        const model::Frame a = renderer.renderAll(sky), b = renderer.renderAll(map);
        // Sums of a map's harmonics over its pixels differ from a sky's by some millionths: steps of 8 bits, here and there.
        int far = 0;
        for (std::size_t i = 0; i < a.pixels.rgba.size(); ++i) far += std::abs(a.pixels.rgba[i] - b.pixels.rgba[i]) > 3;
        EXPECT_LT(far, payload == model::TexelPayload::kIrradiance ? 1 : 100);
    }
    model::FrameRequest wanted = request(30);
    lightOf(wanted).environment = model::EnvironmentLight{"volume", 1};
    EXPECT_EQ(codeOf([&] { renderer.renderAll(wanted); }), Code::kInvalidArgument) << "no map";
    lightOf(wanted).environment = model::EnvironmentLight{"nothing", 1};
    EXPECT_EQ(codeOf([&] { renderer.renderAll(wanted); }), Code::kNotFound);
}

TEST_F(GlobalLight, WholeLatticesServeEveryCameraAndTheNextStart) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("radiata-lattices-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    const model::ScalarImage ball = foldedBall(24);
    io::writeNifti({{24, 24, 24, 1}, ball.voxel_to_world, ball.values, ""}, folder / "volume.nii");
    store.add(folder / "volume.nii");
    model::FrameRequest wanted = request(30);
    lightOf(wanted).full = true;
    lightOf(wanted).project = false;
    lightOf(wanted).samples_max = 32;
    const model::Frame first = renderer.renderAll(wanted);
    EXPECT_EQ(first.info.illumination->texels_done, 24u * 24 * 24);
    EXPECT_THAT(first.info.illumination->saved,
                testing::AllOf(testing::StartsWith("volume.nii-"), testing::EndsWith(".lattice")));
    model::FrameRequest turned = wanted;
    turned.camera.eye_mm = {-60, 40, -25};
    turned.scene.layers[0].surface().isovalue = 45;
    lightOf(turned).full = false;
    EXPECT_EQ(renderer.renderAll(turned).info.illumination->samples, 0u) << "every camera and isovalue has its texels";

    // Another start: the same texels without a path.
    store::Store next_store(device, {});
    next_store.add(folder / "volume.nii");
    render::Renderer next(device, next_store);
    const std::vector<render::SavedFile> files = render::savedFiles(next_store, wanted);
    ASSERT_EQ(files.size(), 1u);
    EXPECT_EQ(files[0].file.filename(), first.info.illumination->saved);
    store::SavedLattices& saved = next_store.savedLattices();
    EXPECT_FALSE(saved.resident(files[0].file));
    saved.read(files[0].file, files[0].header);
    EXPECT_TRUE(saved.resident(files[0].file));
    // Cut short: who draws does not read it again, and once the texels are dropped it is no reason to fail.
    std::filesystem::resize_file(files[0].file, 5000);
    const model::Frame again = next.renderAll(wanted);
    EXPECT_EQ(again.info.illumination->texels_read, 24u * 24 * 24);
    EXPECT_EQ(again.info.illumination->samples, 0u);
    EXPECT_EQ(again.pixels.rgba, first.pixels.rgba);
    model::FrameRequest dark = wanted;
    lightOf(dark).full = false;
    lightOf(dark).sky.radiance = glm::vec3(0.2F);
    next.renderAll(dark);
    EXPECT_FALSE(saved.resident(files[0].file)) << "its texels are dropped, so they are to be read again";
    store::Store third_store(device, {});
    third_store.add(folder / "volume.nii");
    render::Renderer third(device, third_store);
    EXPECT_EQ(third.renderAll(wanted).pixels.rgba, first.pixels.rgba);
    std::filesystem::remove_all(folder);
}

TEST_F(GlobalLight, RefusesWhatCannotBe) {
    store.add("volume", ball(12, 4));
    const auto refused = [&](const std::function<void(model::Illumination&)>& change) {
        model::FrameRequest wanted = request(0);
        change(lightOf(wanted));
        return codeOf([&] { renderer.renderAll(wanted); });
    };
    EXPECT_EQ(refused([](auto& light) { light.bounces = 5; }), Code::kInvalidArgument);
    EXPECT_EQ(refused([](auto& light) { light.orders[1] = 6; }), Code::kInvalidArgument);
    EXPECT_EQ(refused([](auto& light) { light.samples_max = 100; }), Code::kInvalidArgument) << "no power of two";
    EXPECT_EQ(refused([](auto& light) { light.relative_error = std::nanf(""); }), Code::kInvalidArgument);
    EXPECT_EQ(refused([](auto& light) { light.sky.gradient.y = -1; }), Code::kInvalidArgument) << "negative sky";
    EXPECT_EQ(refused([](auto& light) { light.rotation = {0, 0, 0, 0}; }), Code::kInvalidArgument);
    EXPECT_EQ(refused([](auto& light) { light.suns.emplace_back().angular_radius_deg = 0; }), Code::kInvalidArgument);
    EXPECT_EQ(refused([](auto& light) { light.full = true; }), Code::kInvalidArgument) << "all texels on one surface";
    EXPECT_EQ(refused([](auto& light) {
                  light.payload = model::TexelPayload::kTransfer;
                  light.storage = model::TexelStorage::kRgb8;
              }),
              Code::kInvalidArgument);
    EXPECT_EQ(refused([](auto& light) { light.environment = model::EnvironmentLight{"sky", -1}; }), Code::kInvalidArgument);
    EXPECT_EQ(refused([](auto& light) {
                  light.lights.emplace_back();
                  light.payload = model::TexelPayload::kTransfer;
              }),
              Code::kInvalidArgument);
}

}  // namespace
}  // namespace radiata::test
