// Uncertainty in a plan: passes only where a layer asks, after all layers; tables and lists as the layers have them.
#include "plan/plan_uncertainty.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "shaders/modules.h"

namespace radiata::plan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr Abilities kAll{true, true, true, false};

LayerFacts facts(int lmax = 8) {
    LayerFacts layer;
    layer.layout = {lmax, false};
    layer.glyphs = layer.glyphs_available = 100;
    layer.voxel_edge_mm = 2;
    return layer;
}

/// Two layers, of which the second shows its uncertainty.
struct Scene {
    model::FrameRequest request;
    std::vector<LayerFacts> layers{facts(), facts(4)};

    Scene() {
        request.scene.layers.resize(2);
        request.scene.layers[1].glyphs().uncertainty.emplace().dataset_id = "outer";
        layers[1].uncertainty = {facts(6)};
    }
    FramePlan plan(const Abilities& abilities = kAll) const { return planFrame(request, layers, abilities); }
};

std::vector<std::string> passes(const FramePlan& plan) {
    std::vector<std::string> result;
    for (const PassPlan& pass : plan.passes) {
        result.push_back(pass.name + " by " + pass.shader);
        EXPECT_NO_THROW(shaders::module(pass.shader));
    }
    return result;
}

TEST(PlanUncertainty, IsOnePassOfTheLayerThatAsks) {
    Scene scene;
    const FramePlan plan = scene.plan();
    EXPECT_THAT(passes(plan), ElementsAre("glyph trace 0 by glyph_trace_even8", "glyph trace 1 by glyph_trace_even4",
                                          "uncertainty 1 by glyph_uncertainty_even4", "light by light", "resolve by resolve"));
    EXPECT_TRUE(plan.usesUncertainty());
    EXPECT_FALSE(plan.uncertainty[0]);
    EXPECT_EQ(plan.uncertainty[1]->used, 15U) << "bands above the layer's are left out";
    EXPECT_FLOAT_EQ(*plan.resolved.scene.layers[1].glyphs().uncertainty->extinction_per_mm, 2);
    scene.request.scene.layers[1].glyphs().uncertainty.reset();
    const FramePlan without = scene.plan();
    EXPECT_EQ(without.passes.size(), 4U);
    EXPECT_FALSE(without.usesUncertainty());
}

TEST(PlanUncertainty, HasTablesWhereTheLayersHaveThemAndTheCameraIsFarFromItsGlyphs) {
    Scene scene;
    scene.request.quality.pole_table = model::PoleTable::kOn;
    scene.request.scene.layers[1].glyphs().negative_lobes = model::NegativeLobes::kShown;
    const FramePlan plan = scene.plan();
    EXPECT_THAT(passes(plan), ::testing::Contains("uncertainty table 1 by glyph_table_even4"));
    EXPECT_TRUE(plan.uncertainty[1]->pole_table);
    EXPECT_TRUE(plan.uncertainty[1]->both_lobes);
    // What is echoed plans to the same passes.
    EXPECT_EQ(passes(planFrame(plan.resolved, scene.layers, kAll)), passes(plan));
    scene.layers[1].uncertainty[0].camera_close = true;
    EXPECT_FALSE(scene.plan().uncertainty[1]->pole_table);
}

TEST(PlanUncertainty, CountsItsBoxesWhenTraversalIsChosen) {
    Scene scene;
    EXPECT_EQ(scene.plan().resolved.quality.traversal, model::Traversal::kTiles);
    scene.layers[1].uncertainty[0].depth_complexity = 40;
    EXPECT_NE(scene.plan().resolved.quality.traversal, model::Traversal::kTiles);
}

TEST(PlanUncertainty, NeedsAWayToAllBoxes) {
    Scene scene;
    scene.request.quality.traversal = model::Traversal::kRayQuery;
    EXPECT_NO_THROW(scene.plan());
    try {
        scene.plan({true, false, true, false});
        ADD_FAILURE() << "no Error was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), Code::kUnsupported);
        EXPECT_THAT(error.what(), HasSubstr("layers[1]"));
    }
}

}  // namespace
}  // namespace radiata::plan
