// Every field of a request at and beyond the border of what is allowed.
#include "model/limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "base/error.h"

namespace radiata::model {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

FrameRequest sound() {
    FrameRequest request;
    Layer layer;
    layer.glyphs().dataset_id = "brain";
    request.scene.layers = {layer};
    return request;
}

GlyphLayer& glyphs(FrameRequest& request) { return request.scene.layers[0].glyphs(); }

/// A change that makes a sound request unusable, and the field that the sentence must name.
struct Case {
    std::string field;
    Code code;
    std::function<void(FrameRequest&)> change;
};

void expectRefused(const Case& bad) {
    FrameRequest request = sound();
    bad.change(request);
    try {
        validate(request, Limits{});
        FAIL() << bad.field << " was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), bad.code) << error.what();
        EXPECT_NE(std::string(error.what()).find(bad.field), std::string::npos) << error.what();
    }
}

TEST(Limits, AcceptsTheDefaultsAndTheLargestRequest) {
    validate(sound(), Limits{});
    FrameRequest request = sound();
    request.width = 8192;
    request.height = 2048;
    request.quality.samples = 64;
    request.quality.jpeg_quality = 100;
    glyphs(request).lmax = 16;
    glyphs(request).scale.factor = 1e6F;
    request.scene.layers.assign(8, request.scene.layers[0]);
    validate(request, Limits{});
}

TEST(Limits, RefusesPicturesOfTheWrongSize) {
    const auto size = [](int width, int height) { return [=](FrameRequest& r) { r.width = width, r.height = height; }; };
    expectRefused({"picture size", Code::kInvalidArgument, size(0, 100)});
    expectRefused({"picture size", Code::kInvalidArgument, size(100, -1)});
    expectRefused({"8193x1", Code::kResourceExhausted, size(8193, 1)});
    expectRefused({"1x8193", Code::kResourceExhausted, size(1, 8193)});
    expectRefused({"8192x2049", Code::kResourceExhausted, size(8192, 2049)});
    expectRefused({"picture size", Code::kResourceExhausted, size(2147483647, 2147483647)});
}

TEST(Limits, RefusesQualityOutOfRange) {
    for (const int samples : {0, -1, 65, 2147483647}) {
        expectRefused({"quality.samples", Code::kInvalidArgument, [=](FrameRequest& r) { r.quality.samples = samples; }});
    }
    for (const int quality : {0, -5, 101}) {
        expectRefused({"jpeg_quality", Code::kInvalidArgument, [=](FrameRequest& r) { r.quality.jpeg_quality = quality; }});
    }
    for (const FibletCulling culling : {FibletCulling::kFrustum, FibletCulling::kNone, FibletCulling::kCoverage}) {
        expectRefused({"frozen_culling", Code::kInvalidArgument, [=](FrameRequest& r) {
                           r.quality.frozen_culling = r.camera;
                           r.quality.fiblet_culling = culling;
                       }});
    }
    for (const FibletCulling culling : {FibletCulling::kAuto, FibletCulling::kTwoPhase}) {
        FrameRequest frozen = sound();
        frozen.quality.frozen_culling = frozen.camera;
        frozen.quality.fiblet_culling = culling;
        EXPECT_NO_THROW(validate(frozen, Limits{}));
    }
}

TEST(Limits, RefusesMethodSettingsOutOfRange) {
    const Code kInvalid = Code::kInvalidArgument;
    for (const int steps : {0, -1, 1001, 2147483647}) {
        expectRefused({"ray_march.steps", kInvalid, [=](FrameRequest& r) { r.quality.ray_march.steps = steps; }});
    }
    for (const int refinements : {-1, 33}) {
        expectRefused(
            {"ray_march.refinements", kInvalid, [=](FrameRequest& r) { r.quality.ray_march.refinements = refinements; }});
    }
    for (const double tolerance : {0.0, -1.0, 1e-16, 0.11, double{kNan}, double{kInfinity}}) {
        expectRefused({"polynomial.tolerance", kInvalid, [=](FrameRequest& r) { r.quality.polynomial.tolerance = tolerance; }});
    }
    expectRefused({"contradicts the method pole-table", kInvalid, [](FrameRequest& r) {
                       r.quality.intersection = Intersection::kPoleTable;
                       r.quality.pole_table = PoleTable::kOff;
                   }});
}

TEST(Limits, RefusesUnusableLayers) {
    const Code kInvalid = Code::kInvalidArgument;
    expectRefused({"scene.layers is empty", kInvalid, [](FrameRequest& r) { r.scene.layers.clear(); }});
    expectRefused({"9 layers", Code::kResourceExhausted, [](FrameRequest& r) { r.scene.layers.resize(9); }});
    expectRefused({"layers[0].glyphs.dataset_id", kInvalid, [](FrameRequest& r) { glyphs(r).dataset_id.clear(); }});
    expectRefused({"layers[1]", kInvalid, [](FrameRequest& r) {
                       r.scene.layers.push_back(r.scene.layers[0]);
                       r.scene.layers[1].glyphs().lmax = -1;
                   }});
    expectRefused({"lmax", kInvalid, [](FrameRequest& r) { glyphs(r).lmax = 17; }});
    for (const float factor : {0.0F, -1.0F, 2e6F, kNan, kInfinity}) {
        expectRefused({"scale.factor", kInvalid, [=](FrameRequest& r) { glyphs(r).scale.factor = factor; }});
    }
    for (const float opacity : {0.0F, -1.0F, 1.01F, kNan}) {
        expectRefused({"opacity", kInvalid, [=](FrameRequest& r) { r.scene.layers[0].opacity = opacity; }});
    }
}

TEST(Limits, RefusesUnusableColours) {
    const Code kInvalid = Code::kInvalidArgument;
    const auto change = [](ColourMode mode, const std::function<void(GlyphColour&)>& more) {
        return [=](FrameRequest& r) {
            glyphs(r).colour.mode = mode;
            more(glyphs(r).colour);
        };
    };
    expectRefused({"colour.scalar.image_id is empty", kInvalid, change(ColourMode::kScalar, [](GlyphColour&) {})});
    for (const ColourRange range : {ColourRange{1, 1}, {2, 1}, {kNan, 1}, {0, kNan}, {-kInfinity, 0}, {-3e38F, 3e38F}}) {
        expectRefused({"colour", kInvalid, change(ColourMode::kRadius, [=](GlyphColour& c) { c.range = range; })});
    }
    for (const float channel : {-0.1F, 1.1F, kNan}) {
        expectRefused(
            {"colour.uniform", kInvalid, change(ColourMode::kUniform, [=](GlyphColour& c) { c.uniform.y = channel; })});
    }
    FrameRequest request = sound();
    glyphs(request).colour.uniform = {2, 2, 2};  // not used
    glyphs(request).colour.range = ColourRange{1, 0};
    validate(request, Limits{});
}

TEST(Limits, RefusesSelectionsWithoutAPlane) {
    const auto selection = [](const std::function<void(VoxelSelection&)>& change) {
        return [=](FrameRequest& r) {
            glyphs(r).selection.region = Region::kSlab;
            glyphs(r).selection.thickness_mm = 1;
            change(glyphs(r).selection);
        };
    };
    const Code kInvalid = Code::kInvalidArgument;
    expectRefused({"thickness_mm", kInvalid, selection([](VoxelSelection& s) { s.thickness_mm = 0; })});
    expectRefused({"thickness_mm", kInvalid, selection([](VoxelSelection& s) { s.thickness_mm = std::nan(""); })});
    expectRefused({"position_mm", kInvalid, selection([](VoxelSelection& s) { s.position_mm = glm::dvec3(0, kNan, 0); })});
    for (const glm::dvec3& normal : {glm::dvec3(0), glm::dvec3(kNan, 0, 1), glm::dvec3(kInfinity, 0, 0)}) {
        expectRefused(
            {"normal", kInvalid, selection([=](VoxelSelection& s) { s.plane = Plane::kOblique, s.normal = normal; })});
    }
    FrameRequest request = sound();
    glyphs(request).selection.normal = glm::dvec3(0);
    validate(request, Limits{});
}

TEST(Limits, RefusesUnusableLightAndBackground) {
    const Code kInvalid = Code::kInvalidArgument;
    expectRefused({"direction_camera", kInvalid, [](FrameRequest& r) { r.scene.light.direction_camera = glm::dvec3(0); }});
    expectRefused({"direction_camera", kInvalid, [](FrameRequest& r) { r.scene.light.direction_camera.x = kNan; }});
    for (const float value : {-1.0F, 101.0F, kNan}) {
        expectRefused({"irradiance", kInvalid, [=](FrameRequest& r) { r.scene.light.irradiance = value; }});
        expectRefused({"ambient", kInvalid, [=](FrameRequest& r) { r.scene.light.ambient = value; }});
        expectRefused({"background", kInvalid, [=](FrameRequest& r) { r.scene.background.y = value; }});
    }
}

TEST(Limits, RefusesUnusableShadowsAndAmbientOcclusion) {
    const Code kInvalid = Code::kInvalidArgument;
    for (const float value : {0.0F, -1.0F, kNan, kInfinity, 60.1F}) {
        expectRefused({"angular_radius_deg", kInvalid, [=](FrameRequest& r) { r.scene.light.angular_radius_deg = value; }});
    }
    for (const float value : {0.0F, -1.0F, kNan, kInfinity}) {
        expectRefused({"radius_mm", kInvalid, [=](FrameRequest& r) { r.scene.light.ambient_occlusion = {16, value}; }});
    }
    for (const int value : {0, -1, 33, 10000}) {
        expectRefused({"shadow_rays", kInvalid, [=](FrameRequest& r) { r.scene.light.shadow_rays = value; }});
        expectRefused({"ambient_occlusion.rays", kInvalid, [=](FrameRequest& r) {
                           r.scene.light.ambient_occlusion = {value, std::nullopt};
                       }});
    }
    for (const glm::dvec3& direction : {glm::dvec3(0), glm::dvec3(kNan, 0, 1), glm::dvec3(kInfinity, 0, 0)}) {
        expectRefused({"direction_world", kInvalid, [=](FrameRequest& r) { r.scene.light.direction_world = direction; }});
    }
    FrameRequest request = sound();
    request.scene.light.shadow = Shadow::kSoft;
    request.scene.light.angular_radius_deg = 60;
    request.scene.light.shadow_rays = 32;
    request.scene.light.ambient_occlusion = {32, 1e6F};
    request.scene.light.direction_world = glm::dvec3(0, 0, -1);
    request.scene.light.direction_camera = glm::dvec3(0);  // not used then
    validate(request, Limits{});
}

TEST(Limits, SaysSmallValuesAsTheyAre) {
    expectRefused({"step is 1e-09; it must be 0.05 to 4", Code::kInvalidArgument,
                   [](FrameRequest& r) { r.quality.isosurface.step = 1e-9F; }});
    expectRefused({"irradiance is 100.5; it must be 0 to 100", Code::kInvalidArgument,
                   [](FrameRequest& r) { r.scene.light.irradiance = 100.5F; }});
}

TEST(Limits, ChecksTheCamera) {
    expectRefused({"camera: up", Code::kInvalidArgument, [](FrameRequest& r) { r.camera.up = glm::dvec3(0); }});
}

}  // namespace
}  // namespace radiata::model
