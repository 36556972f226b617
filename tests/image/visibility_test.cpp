// Shadows and ambient occlusion in whole pictures: against every glyph tested in double, against spheres whose shadows have a
// closed form, by statistics where rays are spread, and at no cost where the scene does not ask for them.
#include "reference/visibility.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "image/fixture.h"
#include "reference/glyph_hits.h"
#include "reference/projected_cap.h"
#include "reference/shading.h"
#include "store/glyph_dataset.h"

namespace radiata::test {
namespace {

/// A large ball at the origin and a small one 2 mm above it.
constexpr double kBig = 0.9, kSmall = 0.35, kUp = 2;

class Visibility : public ImageTest {
protected:
    static glm::dvec3 at(const std::vector<float>& values, std::size_t pixel) {
        return {values[3 * pixel], values[3 * pixel + 1], values[3 * pixel + 2]};
    }
    static bool black(const model::Frame& frame, std::size_t pixel) {
        const auto* rgba = frame.pixels.rgba.data() + 4 * pixel;
        return rgba[0] == 0 && rgba[1] == 0 && rgba[2] == 0;
    }
    static double linear(const model::Frame& frame, std::size_t pixel, int channel) {
        return reference::linearFromSrgb(frame.pixels.rgba[4 * pixel + static_cast<std::size_t>(channel)] / 255.0);
    }

    model::FrameRequest balls() {
        model::ShImage image;
        image.size = {1, 1, 2};
        image.layout = {2, false};
        image.voxel_to_world[2][2] = kUp;
        image.voxels = {{0, 0, 0}, {0, 0, 1}};
        const double unit = std::sqrt(4 * std::numbers::pi);
        image.coefficients.assign(2 * image.layout.count(), 0.0F);
        image.coefficients[0] = static_cast<float>(kBig * unit);
        image.coefficients[image.layout.count()] = static_cast<float>(kSmall * unit);
        store.add("balls", image);
        model::FrameRequest request = requestOf("balls", 160, 120, 1);
        request.camera = {{3, -4, 5}, {0, 0, 0.6}, {0, 0, 1}, false, 30, 4, {}};
        request.scene.light.direction_world = glm::dvec3(0, 0, 1);
        return request;
    }
    /// Whether a ray from the big ball meets the small one.
    static bool meetsSmall(const glm::dvec3& origin, const glm::dvec3& direction) {
        const glm::dvec3 from = origin - glm::dvec3(0, 0, kUp);
        const double along = glm::dot(from, direction);
        return along < 0 && glm::dot(from, from) - along * along < kSmall * kSmall;
    }
    static glm::dvec3 position(const model::Frame& frame, std::size_t pixel) {
        return frame.info.position_origin_mm + at(frame.pixels.position, pixel);
    }
};

/// Each pixel is lit or dark as the exhaustive test of all glyphs says, however boxes and circles are found.
TEST_F(Visibility, HardShadowsAmongRandomGlyphsAreThoseOfTheTwin) {
    for (const ShLayout layout : {ShLayout{8, false}, ShLayout{4, true}}) {
        const model::ShImage image = randomField(layout, {3, 3, 2}, 71, obliqueAffine());
        const std::string id = "field" + std::to_string(layout.lmax);
        store.add(id, image);
        std::vector<reference::ShFunction> functions;
        for (std::size_t i = 0; i < image.voxels.size(); ++i) {
            functions.emplace_back(layout, std::span(image.coefficients).subspan(i * layout.count(), layout.count()));
        }
        model::FrameRequest request = requestOf(id, 96, 72, 1.6F);
        request.camera = cameraAround(image, {1, 2, 3}, true);
        request.scene.light.direction_world = glm::dvec3(2, -0.6, 1.5);
        request.scene.light.ambient = 0;
        request.scene.light.irradiance = 50;
        request.scene.light.shadow = model::Shadow::kHard;
        std::vector<reference::PlacedGlyph> placed;
        for (std::size_t i = 0; i < functions.size(); ++i) {
            placed.push_back({&functions[i], voxelCentre(image, image.voxels[i]), 1.6F});
        }
        for (const bool both : {false, true}) {
            request.scene.layers[0].glyphs().negative_lobes =
                both ? model::NegativeLobes::kShown : model::NegativeLobes::kHidden;
            request.quality.sun_table = model::PoleTable::kOff;
            const model::Frame frame = draw(request);
            int sure = 0, dark = 0, wrong = 0;
            for (std::size_t pixel = 0; pixel < frame.pixels.depth.size(); pixel += 3) {
                if (frame.pixels.id[4 * pixel] < 0) continue;
                const glm::dvec3 light = glm::normalize(*request.scene.light.direction_world);
                if (glm::dot(at(frame.pixels.normal, pixel), light) < 0.05) continue;
                const glm::ivec3 voxel(frame.pixels.id[4 * pixel + 1], frame.pixels.id[4 * pixel + 2],
                                       frame.pixels.id[4 * pixel + 3]);
                const auto own = static_cast<int>(std::ranges::find(image.voxels, voxel) - image.voxels.begin());
                const reference::Visibility expected =
                    reference::visibilityOf(placed, position(frame, pixel), light, both, own);
                if (!expected.sure) continue;
                ++sure;
                dark += expected.blocked;
                wrong += black(frame, pixel) != expected.blocked;
            }
            EXPECT_EQ(wrong, 0);
            EXPECT_GT(sure, 500);
            EXPECT_GT(dark, 100);
            std::printf("lmax %d, %s: %d pixels, %d in shadow\n", layout.lmax, both ? "both lobes" : "positive lobes", sure,
                        dark);
            // The other ways give the same picture.
            for (const model::Traversal traversal : {model::Traversal::kTiles, model::Traversal::kBvh}) {
                for (const model::PoleTable table : {model::PoleTable::kOn, model::PoleTable::kOff}) {
                    model::FrameRequest other = request;
                    other.quality.traversal = traversal;
                    other.quality.sun_table = table;
                    const model::Frame again = draw(other);
                    int differ = 0;
                    for (std::size_t pixel = 0; pixel < frame.pixels.depth.size(); ++pixel) {
                        differ += black(frame, pixel) != black(again, pixel);
                    }
                    EXPECT_LE(differ, table == model::PoleTable::kOff ? 0 : 4) << "at edges of shadows only";
                }
            }
        }
    }
}

/// The small ball's shadow on the big one is the cylinder of its own radius; the small one is lit all over its upper half.
TEST_F(Visibility, AGlyphAboveAGlyphThrowsItsOutline) {
    model::FrameRequest request = balls();
    request.scene.light.ambient = 0;
    request.scene.light.irradiance = 50;
    request.scene.light.shadow = model::Shadow::kHard;
    const model::Frame frame = draw(request);
    int dark = 0, lit = 0;
    for (std::size_t pixel = 0; pixel < frame.pixels.depth.size(); ++pixel) {
        if (frame.pixels.id[4 * pixel] < 0 || frame.pixels.normal[3 * pixel + 2] < 0.01F) continue;
        const glm::dvec3 p = position(frame, pixel);
        const double across = glm::length(glm::dvec2(p));
        const bool small = frame.pixels.id[4 * pixel + 3] == 1;
        if (!small && std::abs(across - kSmall) < 1e-5) continue;
        const bool shadow = !small && across < kSmall;
        ASSERT_EQ(black(frame, pixel), shadow) << "at " << across;
        (shadow ? dark : lit) += 1;
    }
    EXPECT_GT(dark, 200);
    EXPECT_GT(lit, 1500);
}

/// One sample of 32 rays a pixel: noisy in each pixel, right in the mean over many, and nothing varies where nothing is in the
/// way but the highlight.
TEST_F(Visibility, SoftShadowsHaveTheLightOfTheVisiblePartOfTheSphere) {
    model::FrameRequest request = balls();
    request.scene.light.ambient = 0;
    request.scene.light.irradiance = 1.5F;
    request.scene.light.shadow = model::Shadow::kSoft;
    request.scene.light.angular_radius_deg = 20;
    request.scene.light.shadow_rays = 32;
    const model::Frame frame = draw(request);
    const double radius = 20 * std::numbers::pi / 180, facing = std::numbers::pi * std::pow(std::sin(radius), 2);
    const glm::dvec3 light(0, 0, 1), viewer = glm::normalize(request.camera.eye_mm - request.camera.target_mm);
    double sum = 0, squares = 0;
    int count = 0, penumbra = 0, beyond = 0;
    for (std::size_t pixel = 0; pixel < frame.pixels.depth.size(); pixel += 5) {
        if (frame.pixels.id[4 * pixel] < 0 || frame.pixels.id[4 * pixel + 3] != 0) continue;
        const glm::dvec3 p = position(frame, pixel), normal = glm::normalize(p);
        const glm::dvec3 direction = glm::abs(glm::normalize(p));
        const glm::dvec3 base(reference::linearFromSrgb(direction.x), reference::linearFromSrgb(direction.y),
                              reference::linearFromSrgb(direction.z));
        const auto green = [&](const glm::dvec3& ray, bool blocked) {
            const double cosine = glm::dot(normal, ray);
            if (blocked || cosine <= 0) return 0.0;
            return reference::dielectricBrdfCosine(base, 0.45, normal, viewer, ray).y / cosine;
        };
        const auto integral = [&](bool shadow) {
            return 1.5 / facing *
                   reference::integrateProjectedCap(
                       light, normal, radius, [&](const glm::dvec3& ray) { return green(ray, shadow && meetsSmall(p, ray)); },
                       40);
        };
        const double expected = integral(true), open = integral(false), found = linear(frame, pixel, 1);
        sum += found - expected;
        squares += std::pow(found - expected, 2);
        penumbra += expected > 0.1 * open && expected < 0.9 * open;
        beyond += normal.z < 0 && expected > 0.002;
        ++count;
    }
    EXPECT_GT(count, 400);
    EXPECT_GT(penumbra, 60);
    EXPECT_GT(beyond, 10) << "lit from a sphere of which they see only a part above their horizon";
    const double mean = sum / count, deviation = std::sqrt(squares / count);
    std::printf("soft shadow: %d pixels, mean error %.4f, deviation %.4f\n", count, mean, deviation);
    EXPECT_LT(std::abs(mean), 0.001);
    EXPECT_LT(deviation, 0.004);
    // Fixed seed: the same request gives the same bytes, split over calls or not.
    EXPECT_EQ(draw(request).pixels.rgba, frame.pixels.rgba);
    request.quality.samples = 3;
    render::Target target;
    renderer.render(target, request, 0, 1);
    EXPECT_EQ(renderer.render(target, request, 1, 2).pixels.rgba, renderer.renderAll(request).pixels.rgba);
}

TEST_F(Visibility, AmbientOcclusionIsTheCosineWeightedShareOfTheOpenSky) {
    model::FrameRequest request = balls();
    request.scene.light.irradiance = 0;
    request.scene.light.ambient = 0.9F;
    const model::Frame open = draw(request);
    request.scene.light.ambient_occlusion = model::AmbientOcclusion{32, 1.4F};
    const model::Frame frame = draw(request);
    double sum = 0, squares = 0;
    int count = 0, taken = 0;
    for (std::size_t pixel = 0; pixel < frame.pixels.depth.size(); pixel += 2) {
        if (frame.pixels.id[4 * pixel] < 0 || frame.pixels.id[4 * pixel + 3] != 0) continue;
        const glm::dvec3 p = position(frame, pixel), normal = glm::normalize(p);
        const auto sky = [&](const glm::dvec3& ray) {
            if (!meetsSmall(p, ray)) return 1.0;
            const glm::dvec3 from = p - glm::dvec3(0, 0, kUp);
            const double along = glm::dot(from, ray);
            const double entry = -along - std::sqrt(along * along - glm::dot(from, from) + kSmall * kSmall);
            return entry < 1.4 ? 0.0 : 1.0;
        };
        const double share = reference::integrateProjectedCap(normal, normal, std::numbers::pi / 2, sky, 40) / std::numbers::pi;
        const int channel = normal.x * normal.x > normal.y * normal.y ? 0 : 1;
        const double base = linear(open, pixel, channel);
        if (base < 0.1) continue;
        const double found = linear(frame, pixel, channel) / base;
        sum += found - share;
        squares += std::pow(found - share, 2);
        taken += share < 0.95;
        ++count;
    }
    EXPECT_GT(count, 400);
    EXPECT_GT(taken, 25);
    const double mean = sum / count, deviation = std::sqrt(squares / count);
    std::printf("ambient occlusion: %d pixels, mean error %.4f, deviation %.4f\n", count, mean, deviation);
    EXPECT_LT(std::abs(mean), 0.002);
    EXPECT_LT(deviation, 0.03);
}

std::vector<std::string> shadersOf(const model::Frame& frame) {
    std::vector<std::string> names;
    for (const model::PassTime& pass : frame.info.passes) names.push_back(pass.name + ": " + pass.shader);
    return names;
}

/// Passes, pipelines and device bytes of a scene without an effect are the same before and after others had it, and each
/// effect adds exactly its own.
TEST_F(Visibility, CostsNothingWhereItIsOff) {
    const model::ShImage image = randomField({4, false}, {3, 3, 2}, 73, obliqueAffine());
    store.add("field", image);
    model::FrameRequest plain = requestOf("field", 64, 48, 2);
    plain.camera = cameraAround(image, {1, 2, 3}, true);
    plain.quality.traversal = model::Traversal::kBvh;
    plain.quality.pole_table = model::PoleTable::kOff;
    const std::vector<std::string> passes{"glyph trace: glyph_trace_even4", "light: light"};
    const std::size_t before_all = renderer.pipelineCount();
    render::Target target;
    EXPECT_EQ(shadersOf(renderer.render(target, plain, 0, 1)), passes);
    EXPECT_LE(renderer.pipelineCount(), before_all + 2);
    const std::size_t pipelines = renderer.pipelineCount();
    const std::uint64_t bytes = device.allocatedBytes();

    const auto expectNothing = [&](const model::FrameRequest& request) {
        EXPECT_EQ(shadersOf(renderer.render(target, request, 0, 1)), passes);
        EXPECT_EQ(renderer.pipelineCount(), pipelines);
        EXPECT_EQ(device.allocatedBytes(), bytes);
    };
    model::FrameRequest request = plain;
    request.scene.light.shadow = model::Shadow::kHard;
    request.scene.light.ambient_occlusion = model::AmbientOcclusion{};
    request.scene.layers[0].casts_shadows = false;
    expectNothing(request);  // nobody casts
    request.scene.layers[0].casts_shadows = true;
    request.scene.light.irradiance = 0;
    request.scene.light.ambient = 0;
    expectNothing(request);  // no light to take

    request = plain;
    request.scene.light.shadow = model::Shadow::kHard;
    request.quality.sun_table = model::PoleTable::kOff;
    const std::vector<std::string> hard{passes[0], "shadow: glyph_visibility_even4", passes[1]};
    EXPECT_EQ(shadersOf(renderer.render(target, request, 0, 1)), hard);
    EXPECT_EQ(renderer.pipelineCount(), pipelines + 2) << "one pass and its light";
    // 4 bytes a pixel and a quarter of that to grow; allocations come in whole units.
    EXPECT_LE(device.allocatedBytes(), bytes + 64 * 48 * 5 + 4096);
    EXPECT_GE(device.allocatedBytes(), bytes + 64 * 48 * 4);
    request.quality.sun_table = model::PoleTable::kOn;
    const std::vector<std::string> table{passes[0], "sun table: glyph_table_even4", hard[1], passes[1]};
    EXPECT_EQ(shadersOf(renderer.render(target, request, 0, 1)), table);
    EXPECT_EQ(shadersOf(renderer.render(target, plain, 0, 1)), passes);
}

/// Two layers at one place: only the layer that casts darkens, and both are darkened.
TEST_F(Visibility, OnlyLayersThatCastStandInTheLight) {
    model::FrameRequest request = balls();
    request.scene.light.ambient = 0;
    request.scene.light.shadow = model::Shadow::kHard;
    // The big ball in one layer, the small one in another.
    request.scene.layers.push_back(request.scene.layers[0]);
    for (int i = 0; i < 2; ++i) {
        model::VoxelSelection& selection = request.scene.layers[static_cast<std::size_t>(i)].glyphs().selection;
        selection.region = model::Region::kSlab;
        selection.thickness_mm = 1;
        selection.position_mm = glm::dvec3(0, 0, i * kUp);
    }
    const auto darkOnBig = [&](bool big_casts, bool small_casts) {
        request.scene.layers[0].casts_shadows = big_casts;
        request.scene.layers[1].casts_shadows = small_casts;
        const model::Frame frame = draw(request);
        int dark = 0;
        for (std::size_t pixel = 0; pixel < frame.pixels.depth.size(); ++pixel) {
            dark += frame.pixels.id[4 * pixel] == 0 && frame.pixels.normal[3 * pixel + 2] > 0.05F && black(frame, pixel);
        }
        return dark;
    };
    const int both = darkOnBig(true, true);
    EXPECT_GT(both, 200);
    EXPECT_EQ(darkOnBig(false, true), both);
    EXPECT_EQ(darkOnBig(true, false), 0);
}

class ValidatedVisibility : public ImageTest {
protected:
    ValidatedVisibility()
        : ImageTest(gpu::DeviceOptions{.device = {}, .validation = true, .pipeline_cache = {}, .without = {}}) {}
};

TEST_F(ValidatedVisibility, IsEveryKindOfRay) {
    const model::ShImage image = randomField({4, false}, {3, 2, 2}, 74, obliqueAffine());
    store.add("field", image);
    model::FrameRequest request = requestOf("field", 40, 30, 2);
    request.camera = cameraAround(image, {1, 2, 3}, true);
    request.quality.samples = 2;
    for (const model::Shadow shadow : {model::Shadow::kHard, model::Shadow::kSoft}) {
        for (const model::PoleTable table : {model::PoleTable::kOff, model::PoleTable::kOn}) {
            request.scene.light.shadow = shadow;
            request.quality.sun_table = table;
            request.scene.light.ambient_occlusion = model::AmbientOcclusion{4, std::nullopt};
            EXPECT_EQ(renderer.renderAll(request).info.capped_rays, 0U);
        }
    }
    // A second layer without glyphs.
    request.scene.layers.push_back(request.scene.layers[0]);
    request.scene.layers[1].glyphs().selection.region = model::Region::kSlab;
    request.scene.layers[1].glyphs().selection.thickness_mm = 1;
    request.scene.layers[1].glyphs().selection.position_mm = glm::dvec3(1e5, 0, 0);
    renderer.renderAll(request);
    for (const std::string& message : device.takeValidationMessages()) ADD_FAILURE() << message;
}

}  // namespace
}  // namespace radiata::test
