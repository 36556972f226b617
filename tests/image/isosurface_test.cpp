// Isosurfaces in pictures: hits and normals against the reference in double, together with glyphs, transparent, shadowed, and
// what they cost and refuse.
#include <cmath>
#include <cstdio>
#include <limits>

#include <gmock/gmock.h>

#include "build/folded_ball.h"
#include "image/fixture.h"
#include "reference/camera_rays.h"
#include "reference/scalar_field.h"
#include "reference/shading.h"
#include "store/volume_dataset.h"

namespace radiata::test {
namespace {

using reference::ScalarField;

class Isosurfaces : public ImageTest {
protected:
    static model::FrameRequest surfaceOf(const std::string& dataset, std::optional<float> isovalue, int width = 96,
                                         int height = 72) {
        model::FrameRequest request;
        request.width = width;
        request.height = height;
        request.quality.samples = 1;
        request.scene.layers.emplace_back().content = model::IsosurfaceLayer{.dataset_id = dataset, .isovalue = isovalue};
        return request;
    }
    static std::vector<std::string> passNames(const model::Frame& frame) {
        std::vector<std::string> names;
        for (const model::PassTime& pass : frame.info.passes) names.push_back(pass.name);
        return names;
    }
    static std::string refusal(const std::function<void()>& body) {
        try {
            body();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), Code::kInvalidArgument);
            return error.what();
        }
        ADD_FAILURE() << "taken";
        return {};
    }
};

model::ScalarImage turned(model::ScalarImage image) {
    const glm::dmat4 affine = obliqueAffine();
    const glm::dvec3 middle(0.5 * glm::dvec3(image.size - 1));
    image.voxel_to_world = affine;
    image.voxel_to_world[3] = affine[3] - glm::dvec4(glm::dmat3(affine) * middle, 0);
    return image;
}

model::Camera cameraOn(const model::ScalarImage& image, const glm::dvec3& towards, bool perspective) {
    model::Camera camera;
    const double extent = glm::length(glm::dmat3(image.voxel_to_world) * glm::dvec3(image.size));
    camera.target_mm = glm::dvec3(image.voxel_to_world * glm::dvec4(0.5 * glm::dvec3(image.size - 1), 1));
    camera.eye_mm = camera.target_mm + extent * glm::normalize(towards);
    camera.up = {0, 0, 1};
    camera.perspective = perspective;
    camera.height_mm = 0.6 * extent;
    camera.field_of_view_deg = 35;
    return camera;
}

/// In the volume's grid, t in mm.
reference::Ray gridRay(const model::ScalarImage& image, const reference::Ray& ray) {
    const glm::dmat4 to_grid = glm::inverse(image.voxel_to_world);
    return {glm::dvec3(to_grid * glm::dvec4(ray.origin, 1)), glm::dmat3(to_grid) * ray.direction};
}

TEST_F(Isosurfaces, ShowTheReferencesHitsAndNormals) {
    const model::ScalarImage image = turned(foldedBall(48));
    store.add("ball", image);
    const ScalarField volume(image);
    for (const bool perspective : {true, false}) {
        model::FrameRequest request = surfaceOf("ball", 30.0F);
        request.camera = cameraOn(image, {2, -3, 1}, perspective);
        const model::Frame frame = draw(request);
        int hits = 0, other = 0;
        double worst_mm = 0, worst_normal = 0;
        for (int y = 0; y < request.height; ++y) {
            for (int x = 0; x < request.width; ++x) {
                const auto at = static_cast<std::size_t>(y * request.width + x);
                const reference::Ray world =
                    reference::cameraRay(request.camera, request.width, request.height, x + 0.5, y + 0.5);
                const reference::Ray ray = gridRay(image, world);
                const auto expected = volume.firstHit(ray.origin, ray.direction, 30, 0, 1e6);
                if (expected && expected->margin < 0.01) continue;
                const bool hit = frame.pixels.id[4 * at] == 0;
                other += hit != expected.has_value();
                if (!hit || !expected) continue;
                ++hits;
                const glm::dvec3 p = world.origin + expected->t * world.direction;
                const glm::dvec3 shown =
                    frame.info.position_origin_mm + glm::dvec3(frame.pixels.position[3 * at], frame.pixels.position[3 * at + 1],
                                                               frame.pixels.position[3 * at + 2]);
                const glm::dvec3 n(frame.pixels.normal[3 * at], frame.pixels.normal[3 * at + 1],
                                   frame.pixels.normal[3 * at + 2]);
                worst_mm = std::max(worst_mm, std::abs(glm::dot(shown - p, n)));
                const glm::dvec3 grid = ray.origin + expected->t * ray.direction;
                const glm::dmat3 to_grid(glm::inverse(image.voxel_to_world));
                glm::dvec3 expected_normal = glm::normalize(glm::transpose(to_grid) * volume.splineGradient(grid));
                if (glm::dot(expected_normal, world.direction) > 0) expected_normal = -expected_normal;
                // Where the surface is seen edge-on, which side faces the viewer hangs on rounding.
                if (std::abs(glm::dot(n, world.direction)) > 1e-3)
                    worst_normal = std::max(worst_normal, glm::length(n - expected_normal));
                const glm::ivec3 voxel(glm::round(grid));
                EXPECT_LE(glm::length(glm::dvec3(voxel) - glm::dvec3(frame.pixels.id[4 * at + 1], frame.pixels.id[4 * at + 2],
                                                                     frame.pixels.id[4 * at + 3])),
                          1.01);
            }
        }
        std::printf("%d hits, %d pixels otherwise, worst %.2g mm, normal %.2g\n", hits, other, worst_mm, worst_normal);
        EXPECT_GT(hits, 1500);
        EXPECT_EQ(other, 0);
        EXPECT_LT(worst_mm, 1e-4);
        EXPECT_LT(worst_normal, 1e-3);
        EXPECT_EQ(frame.info.hit_pixels, static_cast<std::uint64_t>(std::ranges::count_if(
                                             frame.pixels.depth, [](float depth) { return std::isfinite(depth); })));
        EXPECT_EQ(passNames(frame), (std::vector<std::string>{"isosurface trace", "light"}));
    }
}

TEST_F(Isosurfaces, AreTheSameWithoutBricksAndNearlySoByMarching) {
    const model::ScalarImage image = turned(foldedBall(48));
    store.add("ball", image);
    model::FrameRequest request = surfaceOf("ball", 30.0F);
    request.camera = cameraOn(image, {2, -3, 1}, true);
    const model::Frame exact = draw(request);
    request.quality.isosurface.bricks = false;
    const Agreement plain = compareSurfaces(exact, draw(request));
    EXPECT_EQ(plain.other_ids, 0);
    EXPECT_LT(plain.worst_apart, 1e-4);
    request.quality.isosurface.bricks = true;
    request.quality.isosurface.method = model::SurfaceMethod::kMarchBisect;
    const Agreement marched = compareSurfaces(exact, draw(request));
    EXPECT_LT(marched.other_ids, marched.hits / 20);
    EXPECT_LT(marched.worst_apart, 0.05);
    request.quality.isosurface.normals = model::SurfaceNormals::kTrilinear;
    EXPECT_NE(draw(request).pixels.normal, exact.pixels.normal);
}

TEST_F(Isosurfaces, OfTrianglesLieNearTheSurface) {
    const model::ScalarImage image = turned(foldedBall(48));
    store.add("ball", image);
    model::FrameRequest request = surfaceOf("ball", 30.0F);
    request.camera = cameraOn(image, {2, -3, 1}, true);
    const model::Frame exact = draw(request);
    request.quality.isosurface.method = model::SurfaceMethod::kMarchingCubes;
    const model::Frame triangles = draw(request);
    EXPECT_EQ(passNames(triangles), (std::vector<std::string>{"isosurface mesh", "isosurface surface", "light"}));
    int hits = 0, other = 0, near = 0;
    double turned_by = 0;
    const auto at3 = [](const auto& v, std::size_t i) { return glm::dvec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]); };
    for (std::size_t at = 0; at < exact.pixels.depth.size(); ++at) {
        const bool a = exact.pixels.id[4 * at] == 0, b = triangles.pixels.id[4 * at] == 0;
        other += a != b;
        if (!a || !b) continue;
        ++hits;
        const glm::dvec3 n = at3(exact.pixels.normal, at);
        const glm::dvec3 apart = exact.info.position_origin_mm - triangles.info.position_origin_mm +
                                 at3(exact.pixels.position, at) - at3(triangles.pixels.position, at);
        near += std::abs(glm::dot(apart, n)) < 0.15;  // voxels are 1 to 1.5 mm
        turned_by += std::acos(std::min(glm::dot(n, at3(triangles.pixels.normal, at)), 1.0)) * 180 / 3.14159265;
    }
    EXPECT_LT(other, hits / 100);
    EXPECT_GT(near, hits * 9 / 10);
    EXPECT_LT(turned_by / hits, 5);
    // Beside glyphs and in any order the nearer one shows; where both are, rounding differs with the first layer.
    store.add("glyphs", randomField({4, false}, {5, 5, 5}, 71, glm::dmat4(1.0)));
    request.scene.layers.push_back(requestOf("glyphs", 96, 72, 0.5F).scene.layers[0]);
    const model::Frame after = draw(request);
    std::swap(request.scene.layers[0], request.scene.layers[1]);
    const model::Frame before = draw(request);
    int swapped = 0;
    for (std::size_t at = 0; at < exact.pixels.depth.size(); ++at) {
        const int a = after.pixels.id[4 * at], b = before.pixels.id[4 * at];
        swapped += a >= 0 ? b == 1 - a : b < 0;
    }
    EXPECT_GE(swapped, static_cast<int>(exact.pixels.depth.size()) - 5);
}

TEST_F(Isosurfaces, AndGlyphsHideEachOtherByDepthInAnyOrder) {
    const model::ShImage glyphs = randomField({4, false}, {5, 5, 5}, 71, glm::dmat4(1.0));
    model::ScalarImage ball = foldedBall(32);
    ball.voxel_to_world = glm::dmat4(0.2);
    ball.voxel_to_world[3] = {-1.0, -1.0, -1.0, 1};
    store.add("glyphs", glyphs);
    store.add("ball", ball);
    model::FrameRequest both = requestOf("glyphs", 128, 96, 0.5F);
    both.camera = cameraAround(glyphs, {1, 2, 3}, true);
    const model::FrameRequest glyphs_only = both;
    both.scene.layers.push_back(surfaceOf("ball", 40.0F).scene.layers[0]);
    model::FrameRequest reversed = both, surface_only = both;
    std::swap(reversed.scene.layers[0], reversed.scene.layers[1]);
    surface_only.scene.layers.erase(surface_only.scene.layers.begin());
    const model::Frame a = draw(glyphs_only), b = draw(surface_only), ab = draw(both), ba = draw(reversed);
    int glyph_pixels = 0, surface_pixels = 0;
    for (std::size_t at = 0; at < a.pixels.depth.size(); ++at) {
        const double depth_a = static_cast<double>(a.pixels.depth[at]) + a.info.depth_offset_mm;
        const double depth_b = static_cast<double>(b.pixels.depth[at]) + b.info.depth_offset_mm;
        if (std::abs(depth_a - depth_b) < 1e-4) continue;
        const int nearest = std::min(depth_a, depth_b) > 1e30 ? -1 : depth_a < depth_b ? 0 : 1;
        ASSERT_EQ(ab.pixels.id[4 * at], nearest) << at;
        ASSERT_EQ(ba.pixels.id[4 * at], nearest < 0 ? -1 : 1 - nearest) << at;
        glyph_pixels += nearest == 0;
        surface_pixels += nearest == 1;
    }
    EXPECT_GT(glyph_pixels, 300);
    EXPECT_GT(surface_pixels, 300);
    EXPECT_EQ(passNames(ab), (std::vector<std::string>{"glyph trace 0", "isosurface trace 1", "light"}));
}

TEST_F(Isosurfaces, ThatAreTransparentShowWhatIsInside) {
    // A shell around a small ball: the centre ray crosses the shell once before the ball and sees it through it.
    model::ScalarImage shell;
    shell.size = glm::ivec3(40);
    for (int k = 0; k < 40; ++k) {
        for (int j = 0; j < 40; ++j) {
            for (int i = 0; i < 40; ++i) shell.values.push_back(20 - glm::length(glm::vec3(i, j, k) - 19.5F));
        }
    }
    store.add("ball", shell);
    model::FrameRequest request = surfaceOf("ball", 15.0F, 33, 33);
    request.camera = cameraOn(shell, {1, 2, 3}, false);
    request.scene.light.irradiance = 0;
    request.scene.light.ambient = 1;  // every surface shows its base colour
    request.scene.layers[0].surface().colour = {1, 0, 0};
    request.scene.layers.push_back(request.scene.layers[0]);
    model::Layer& veil = request.scene.layers[1];
    veil.surface() = {.dataset_id = "ball", .isovalue = 4.0F, .colour = {0, 1, 0}};
    veil.opacity = 0.25F;
    const model::Frame frame = draw(request);
    EXPECT_EQ(passNames(frame), (std::vector<std::string>{"isosurface trace 0", "isosurface veil", "light"}));
    const auto linear = [&frame](int x, int y, int c) {
        return reference::linearFromSrgb(frame.pixels.rgba[static_cast<std::size_t>(4 * (y * 33 + x) + c)] / 255.0);
    };
    EXPECT_NEAR(linear(16, 16, 0), 0.75, 0.01);
    EXPECT_NEAR(linear(16, 16, 1), 0.25, 0.01);
    EXPECT_EQ(frame.pixels.id[4 * (16 * 33 + 16)], 0) << "outputs are those of what is opaque";
    // Beside the small ball two crossings of the shell lie before the background.
    const double beside = 1 - 0.75 * 0.75;
    EXPECT_NEAR(linear(16, 6, 1), beside, 0.01);
    EXPECT_NEAR(linear(16, 6, 0), 0, 0.01);
    // Alone, over an empty buffer.
    request.scene.layers.erase(request.scene.layers.begin());
    const model::Frame alone = draw(request);
    EXPECT_EQ(passNames(alone), (std::vector<std::string>{"clear", "isosurface veil", "light"}));
    EXPECT_NEAR(reference::linearFromSrgb(alone.pixels.rgba[4 * (16 * 33 + 16) + 1] / 255.0), beside, 0.01);
    EXPECT_EQ(alone.info.hit_pixels, 0U);
}

TEST_F(Isosurfaces, CastTheReferencesHardShadows) {
    const model::ScalarImage image = foldedBall(48);
    store.add("ball", image);
    const ScalarField volume(image);
    model::FrameRequest request = surfaceOf("ball", 30.0F);
    request.camera = cameraOn(image, {2, -3, 1}, true);
    request.scene.light.direction_world = glm::normalize(glm::dvec3(1, 0.2, 0.8));
    request.scene.light.ambient = 0;
    const model::Frame open = draw(request);
    request.scene.light.shadow = model::Shadow::kHard;
    const model::Frame shadowed = draw(request);
    EXPECT_EQ(passNames(shadowed), (std::vector<std::string>{"isosurface trace", "shadow", "light"}));
    int lit = 0, dark = 0, wrong = 0;
    const glm::dvec3 light = *request.scene.light.direction_world;
    for (std::size_t at = 0; at < open.pixels.depth.size(); ++at) {
        if (open.pixels.id[4 * at] < 0 || open.pixels.rgba[4 * at] < 20) continue;
        const glm::dvec3 n(open.pixels.normal[3 * at], open.pixels.normal[3 * at + 1], open.pixels.normal[3 * at + 2]);
        const glm::dvec3 p =
            open.info.position_origin_mm +
            glm::dvec3(open.pixels.position[3 * at], open.pixels.position[3 * at + 1], open.pixels.position[3 * at + 2]);
        const glm::dvec3 start = glm::dvec3(glm::inverse(image.voxel_to_world) * glm::dvec4(p + 0.5 * n, 1));
        if (volume.value(start) >= 30) continue;  // rough there: rays begin farther off
        const auto blocker = volume.firstHit(start, light, 30, 0, 1e6);
        if (blocker && blocker->margin < 0.05) continue;
        const bool is_dark = shadowed.pixels.rgba[4 * at] == 0;
        wrong += is_dark != blocker.has_value();
        (is_dark ? dark : lit) += 1;
    }
    std::printf("%d lit, %d in shadow, %d wrong\n", lit, dark, wrong);
    EXPECT_GT(lit, 300);
    EXPECT_GT(dark, 100);
    EXPECT_LE(wrong, 2);
    // A transparent surface casts none.
    request.scene.layers[0].opacity = 0.5F;
    EXPECT_EQ(passNames(draw(request)), (std::vector<std::string>{"clear", "isosurface veil", "light"}));
}

TEST_F(Isosurfaces, OccludeAmbientLightInTheirFolds) {
    const model::ScalarImage image = foldedBall(48);
    store.add("ball", image);
    model::FrameRequest request = surfaceOf("ball", 30.0F);
    request.camera = cameraOn(image, {2, -3, 1}, true);
    request.scene.light.irradiance = 0;
    request.scene.light.ambient = 1;
    request.scene.light.ambient_occlusion = model::AmbientOcclusion{.rays = 32, .radius_mm = 12.0F};
    const model::Frame frame = draw(request);
    EXPECT_EQ(passNames(frame), (std::vector<std::string>{"isosurface trace", "occlusion", "light"}));
    // On a plane no ray is blocked; in the folds of the ball many are, and nowhere all.
    int open = 0, deep = 0, hits = 0;
    for (std::size_t at = 0; at < frame.pixels.depth.size(); ++at) {
        if (frame.pixels.id[4 * at] < 0) continue;
        ++hits;
        const double seen = reference::linearFromSrgb(frame.pixels.rgba[4 * at] / 255.0) / 0.75;
        open += seen > 0.95;
        deep += seen < 0.5;
    }
    EXPECT_GT(open, hits / 20);
    EXPECT_GT(deep, hits / 20);
    model::ScalarImage ramp;
    ramp.size = {8, 8, 8};
    for (int n = 0; n < 512; ++n) ramp.values.push_back(static_cast<float>(n / 64));
    store.add("ramp", ramp);
    request.scene.layers[0].surface() = {.dataset_id = "ramp", .isovalue = 3.3F};
    request.camera = cameraOn(ramp, {0.3, 0.2, -1}, true);
    const model::Frame flat = draw(request);
    for (std::size_t at = 0; at < flat.pixels.depth.size(); ++at) {
        if (flat.pixels.id[4 * at] < 0) continue;
        EXPECT_NEAR(reference::linearFromSrgb(flat.pixels.rgba[4 * at] / 255.0), 0.75, 0.01);
    }
}

TEST_F(Isosurfaces, ArePickedWhereTheyAreShown) {
    const model::ScalarImage image = turned(foldedBall(48));
    store.add("ball", image);
    model::FrameRequest request = surfaceOf("ball", 30.0F);
    request.camera = cameraOn(image, {2, -3, 1}, true);
    request.quality.samples = 4;
    const model::Frame frame = draw(request);
    int hits = 0;
    for (int y = 0; y < request.height; y += 7) {
        for (int x = 0; x < request.width; x += 5) {
            const auto at = static_cast<std::size_t>(y * request.width + x);
            const auto picked = renderer.pick(request, x, y);
            ASSERT_EQ(picked.has_value(), frame.pixels.id[4 * at] == 0);
            if (!picked) continue;
            ++hits;
            const auto& surface = std::get<model::PickedSurface>(*picked);
            EXPECT_EQ(surface.dataset_id, "ball");
            EXPECT_EQ(surface.value, 30);
            for (int c = 0; c < 3; ++c) {
                const std::size_t i = 3 * at + static_cast<std::size_t>(c);
                EXPECT_EQ(surface.voxel[c], frame.pixels.id[4 * at + 1 + static_cast<std::size_t>(c)]);
                EXPECT_NEAR(surface.position_mm[c],
                            frame.info.position_origin_mm[c] + static_cast<double>(frame.pixels.position[i]), 1e-4);
                EXPECT_NEAR(surface.normal[c], frame.pixels.normal[i], 1e-4);
            }
        }
    }
    EXPECT_GT(hits, 40);
}

TEST_F(Isosurfaces, RefuseWhatTheyCannotShow) {
    store.add("ball", foldedBall(16));
    EXPECT_THAT(
        refusal([&] { draw(surfaceOf("ball", 5000.0F)); }),
        ::testing::AllOf(::testing::HasSubstr("isovalue is 5000; 'ball' has values from "), ::testing::HasSubstr("to ")));
    model::ScalarImage slice;
    slice.size = {20, 20, 1};
    slice.values.assign(400, 1);
    slice.source = "slice";
    store.add("slice", slice);
    EXPECT_THAT(refusal([&] { draw(surfaceOf("slice", 1.0F)); }), ::testing::HasSubstr("at least 2 along each axis"));
    model::ScalarImage empty = foldedBall(8);
    std::ranges::fill(empty.values, std::numeric_limits<float>::quiet_NaN());
    store.add("empty", empty);
    EXPECT_THAT(refusal([&] { draw(surfaceOf("empty", {})); }), ::testing::HasSubstr("none of the 512 voxels"));
    store.add("glyphs", randomField({4, false}, {2, 2, 2}, 71, glm::dmat4(1.0)));
    EXPECT_THAT(refusal([&] { draw(surfaceOf("glyphs", {})); }), ::testing::HasSubstr("isosurfaces need one"));
}

TEST_F(Isosurfaces, ChooseAValueThatSplitsTheVolumeAndLeaveOutNaN) {
    model::ScalarImage image;  // a cube of 10 in 2, with a hole of NaN in its middle
    image.size = glm::ivec3(20);
    for (int n = 0; n < 8000; ++n) {
        const glm::ivec3 v(n % 20, n / 20 % 20, n / 400);
        const bool inside = glm::all(glm::greaterThan(v, glm::ivec3(4))) && glm::all(glm::lessThan(v, glm::ivec3(15)));
        const bool hole = glm::all(glm::greaterThan(v, glm::ivec3(7))) && glm::all(glm::lessThan(v, glm::ivec3(12)));
        image.values.push_back(hole ? std::numeric_limits<float>::quiet_NaN() : inside ? 10.0F : 2.0F);
    }
    store.add("cube", image);
    EXPECT_EQ(store.volume("cube")->noValue(), 64U);
    model::FrameRequest request = surfaceOf("cube", {}, 33, 33);
    request.camera = cameraOn(image, {1, 0.01, 0.02}, false);
    const model::Frame frame = draw(request);
    const float isovalue = *frame.info.request.scene.layers[0].surface().isovalue;
    EXPECT_GT(isovalue, 2.0F);
    EXPECT_LT(isovalue, 10.0F);
    EXPECT_EQ(frame.pixels.id[4 * (16 * 33 + 16)], 0);
    EXPECT_GE(frame.pixels.id[4 * (16 * 33 + 16) + 1], 14) << "the cube's face, not the hole behind it";
}

}  // namespace
}  // namespace radiata::test
