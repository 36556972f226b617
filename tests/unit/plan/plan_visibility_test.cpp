// Which passes of secondary rays a scene gets, and what becomes of the choices it left open.
#include <gmock/gmock.h>

#include "base/error.h"
#include "plan/plan.h"
#include "shaders/modules.h"

namespace radiata::plan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr Abilities kAll{true, true, true, false};

model::FrameRequest request(std::size_t layers = 1) {
    model::FrameRequest frame;
    frame.scene.layers.resize(layers);
    for (model::Layer& layer : frame.scene.layers) layer.glyphs().dataset_id = "any";
    frame.quality.pole_table = model::PoleTable::kOff;
    return frame;
}

std::vector<LayerFacts> facts(std::size_t layers = 1, double rays_per_glyph = 1) {
    LayerFacts layer;
    layer.layout = {8, false};
    layer.glyphs = layer.glyphs_available = 100;
    layer.rays_per_glyph = rays_per_glyph;
    layer.voxel_edge_mm = 1.5;
    return std::vector<LayerFacts>(layers, layer);
}

std::vector<std::string> names(const FramePlan& plan) {
    std::vector<std::string> result;
    for (const PassPlan& pass : plan.passes) result.push_back(pass.name);
    return result;
}

TEST(PlanVisibility, PlansNothingThatIsNotAskedForOrCannotBeSeen) {
    const std::vector<std::string> plain{"glyph trace", "light", "resolve"};
    model::FrameRequest frame = request();
    EXPECT_EQ(names(planFrame(frame, facts(), kAll)), plain);
    EXPECT_EQ(planFrame(frame, facts(), kAll).visibility.sun_table_reason, "");
    frame.scene.light.shadow = model::Shadow::kSoft;
    frame.scene.light.ambient_occlusion = model::AmbientOcclusion{};
    model::FrameRequest dark = frame;
    dark.scene.light.irradiance = dark.scene.light.ambient = 0;
    EXPECT_EQ(names(planFrame(dark, facts(), kAll)), plain);
    frame.scene.layers[0].casts_shadows = false;
    EXPECT_EQ(names(planFrame(frame, facts(), kAll)), plain);
}

TEST(PlanVisibility, TracesAllLayersBeforeRaysOfThoseThatCast) {
    model::FrameRequest frame = request(2);
    frame.scene.light.shadow = model::Shadow::kHard;
    frame.scene.light.ambient_occlusion = model::AmbientOcclusion{};
    const FramePlan plan = planFrame(frame, facts(2, 100), kAll);
    EXPECT_THAT(names(plan), ElementsAre("glyph trace 0", "glyph trace 1", "sun table 0", "shadow 0", "occlusion 0",
                                         "sun table 1", "shadow 1", "occlusion 1", "light", "resolve"));
    for (const PassPlan& pass : plan.passes) EXPECT_EQ(shaders::module(pass.shader).name, pass.shader);
    frame.scene.layers[0].casts_shadows = false;
    EXPECT_THAT(names(planFrame(frame, facts(2), kAll)),
                ElementsAre("glyph trace 0", "glyph trace 1", "shadow 1", "occlusion 1", "light", "resolve"));
    frame.scene.light.shadow = model::Shadow::kSoft;
    frame.scene.light.ambient = 0;
    EXPECT_THAT(names(planFrame(frame, facts(2, 100), kAll)),
                ElementsAre("glyph trace 0", "glyph trace 1", "shadow 1", "light", "resolve"));
}

TEST(PlanVisibility, ChoosesTheSunTableByRaysPerGlyphAndSaysSo) {
    model::FrameRequest frame = request();
    frame.scene.light.shadow = model::Shadow::kHard;
    FramePlan plan = planFrame(frame, facts(1, kSunTableRays), kAll);
    EXPECT_TRUE(plan.visibility.sun_table);
    EXPECT_EQ(plan.visibility.sun_table_reason, "on: about 12.0 rays per glyph; it pays from 12.0");
    EXPECT_EQ(plan.resolved.quality.sun_table, model::PoleTable::kOn);
    plan = planFrame(frame, facts(1, 11.9), kAll);
    EXPECT_FALSE(plan.visibility.sun_table);
    EXPECT_EQ(plan.visibility.sun_table_reason, "off: about 11.9 rays per glyph; it pays from 12.0");
    frame.quality.sun_table = model::PoleTable::kOn;
    EXPECT_EQ(planFrame(frame, facts(1, 1), kAll).visibility.sun_table_reason, "on: asked for");
    frame.scene.light.shadow = model::Shadow::kSoft;
    EXPECT_FALSE(planFrame(frame, facts(1, 100), kAll).visibility.sun_table);
}

TEST(PlanVisibility, ListsBoxesAlongTheLightWhereTheListsAreShort) {
    model::FrameRequest frame = request();
    frame.scene.light.shadow = model::Shadow::kHard;
    frame.quality.traversal = model::Traversal::kTiles;
    std::vector<LayerFacts> layers = facts();
    layers[0].sun_depth = kTileDepth;
    EXPECT_TRUE(planFrame(frame, layers, kAll).visibility.sun_tiles);
    layers[0].sun_depth = kTileDepth + 0.1;
    EXPECT_FALSE(planFrame(frame, layers, kAll).visibility.sun_tiles);
    layers[0].sun_depth = 1;
    frame.quality.traversal = model::Traversal::kBvh;
    EXPECT_FALSE(planFrame(frame, layers, kAll).visibility.sun_tiles);
    frame.quality.traversal = model::Traversal::kTiles;
    frame.scene.light.shadow = model::Shadow::kSoft;
    EXPECT_FALSE(planFrame(frame, layers, kAll).visibility.sun_tiles);
}

TEST(PlanVisibility, FillsInTheReachOfAmbientOcclusionAndPlansTheSameAgain) {
    model::FrameRequest frame = request();
    frame.scene.light.shadow = model::Shadow::kHard;
    frame.scene.light.ambient_occlusion = model::AmbientOcclusion{8, std::nullopt};
    for (const double rays : {1.0, 100.0}) {
        const FramePlan plan = planFrame(frame, facts(1, rays), kAll);
        EXPECT_EQ(plan.resolved.scene.light.ambient_occlusion->radius_mm, 3.0F);
        const FramePlan again = planFrame(plan.resolved, facts(1, rays), kAll);
        EXPECT_EQ(names(again), names(plan));
        EXPECT_TRUE(again.resolved == plan.resolved);
    }
}

TEST(PlanVisibility, RefusesWhereNoHierarchyWorks) {
    model::FrameRequest frame = request();
    Abilities abilities = kAll;
    abilities.bvh = false;
    EXPECT_EQ(names(planFrame(frame, facts(), abilities)).size(), 3U);
    frame.scene.light.shadow = model::Shadow::kHard;
    try {
        planFrame(frame, facts(), abilities);
        FAIL() << "no Error was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), Code::kUnsupported);
        EXPECT_THAT(error.what(), HasSubstr("draw without them"));
    }
}

}  // namespace
}  // namespace radiata::plan
