// Layers drawn as triangles: their passes, what is left out of the plan, and what is refused.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "plan/plan.h"
#include "shaders/modules.h"

namespace radiata::plan {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Abilities all() {
    Abilities abilities;
    abilities.ray_query = abilities.raster = true;
    return abilities;
}

model::FrameRequest request(std::size_t layers, model::Intersection method, model::Traversal traversal) {
    model::FrameRequest frame;
    frame.scene.layers.resize(layers);
    for (model::Layer& layer : frame.scene.layers) layer.glyphs().dataset_id = "x";
    frame.quality.intersection = method;
    frame.quality.traversal = traversal;
    return frame;
}

LayerFacts facts(std::uint64_t glyphs) {
    LayerFacts layer;
    layer.layout = {8, false};
    layer.glyphs = layer.glyphs_available = glyphs;
    layer.rays_per_glyph = 100;
    return layer;
}

std::vector<std::string> names(const FramePlan& plan) {
    std::vector<std::string> result;
    for (const PassPlan& pass : plan.passes) {
        result.push_back(pass.name);
        EXPECT_NO_THROW(shaders::module(pass.shader)) << pass.shader;
    }
    return result;
}

std::string refusal(const model::FrameRequest& frame, const LayerFacts& layer, const Abilities& abilities, Code code) {
    try {
        planFrame(frame, {layer}, abilities);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code);
        return error.what();
    }
    ADD_FAILURE() << "no Error was thrown";
    return "";
}

TEST(PlanRaster, BoxesTakeThePlaceOfTheTrace) {
    model::FrameRequest frame = request(2, model::Intersection::kMarch, model::Traversal::kRasterBoxes);
    frame.quality.pole_table = model::PoleTable::kOn;
    const FramePlan plan = planFrame(frame, {facts(10), facts(20)}, all());
    EXPECT_THAT(names(plan), ElementsAre("glyph table 0", "glyph boxes 0", "glyph surface 0", "glyph table 1", "glyph boxes 1",
                                         "glyph surface 1", "light", "resolve"));
    EXPECT_EQ(plan.passes[1].shader, "glyph_boxes_even8");
    EXPECT_EQ(plan.resolved.quality.traversal, model::Traversal::kRasterBoxes);
}

TEST(PlanRaster, SpheresNeedNeitherTraversalNorTable) {
    model::FrameRequest frame = request(1, model::Intersection::kTessellated, model::Traversal::kBvh);
    frame.quality.pole_table = model::PoleTable::kOn;
    const FramePlan plan = planFrame(frame, {facts(10)}, all());
    EXPECT_THAT(names(plan), ElementsAre("glyph tessellate", "glyph mesh", "glyph surface", "light", "resolve"));
    EXPECT_EQ(plan.resolved.quality.traversal, model::Traversal::kAuto);
    EXPECT_EQ(plan.resolved.quality.pole_table, model::PoleTable::kOff);
    EXPECT_THAT(plan.traversal_reason, HasSubstr("none"));
    // What is echoed plans to the same passes.
    EXPECT_EQ(names(planFrame(plan.resolved, {facts(10)}, all())), names(plan));
}

TEST(PlanRaster, IsNeverChosenUnasked) {
    for (const double depth : {1.0, 100.0}) {
        LayerFacts layer = facts(10);
        layer.depth_complexity = depth;
        const FramePlan plan = planFrame(request(1, model::Intersection::kMarch, model::Traversal::kAuto), {layer}, all());
        EXPECT_NE(plan.resolved.quality.traversal, model::Traversal::kRasterBoxes);
    }
}

TEST(PlanRaster, RefusesNamingWhatWouldDo) {
    Abilities none = all();
    none.raster = false;
    const auto boxes = request(1, model::Intersection::kMarch, model::Traversal::kRasterBoxes);
    EXPECT_THAT(refusal(boxes, facts(1), none, Code::kUnsupported), HasSubstr("raster_boxes"));
    auto spheres = request(1, model::Intersection::kTessellated, model::Traversal::kAuto);
    EXPECT_THAT(refusal(spheres, facts(1), none, Code::kUnsupported), HasSubstr("use march"));
    const auto other = request(1, model::Intersection::kPolynomial, model::Traversal::kRasterBoxes);
    EXPECT_THAT(refusal(other, facts(1), all(), Code::kUnsupported), HasSubstr("must be march"));
    spheres.quality.tessellation.level = 6;
    EXPECT_THAT(refusal(spheres, facts(30'000), all(), Code::kResourceExhausted),
                HasSubstr("30000 glyphs of 81920 triangles are more than the 2000000000"));
    EXPECT_NO_THROW(planFrame(spheres, {facts(24'000)}, all()));
}

}  // namespace
}  // namespace radiata::plan
