// How a frame is planned: which traversal and why, what becomes of band limits, which passes run with which modules, and that a
// planned frame's resolved request plans to itself.
#include "plan/plan.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "shaders/modules.h"

namespace radiata::plan {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr Abilities kAll{true, true, true, false};

model::FrameRequest request(std::size_t layers = 1) {
    model::FrameRequest frame;
    frame.scene.layers.resize(layers);
    for (model::Layer& layer : frame.scene.layers) layer.glyphs().dataset_id = "any";
    return frame;
}

LayerFacts facts(int lmax = 8, bool full = false) {
    LayerFacts layer;
    layer.layout = {lmax, full};
    layer.glyphs = layer.glyphs_available = 100;
    return layer;
}

LayerFacts deep(double boxes) {
    LayerFacts layer = facts();
    layer.depth_complexity = boxes;
    return layer;
}

LayerFacts withRays(double rays_per_glyph, bool camera_close = false, int lmax = kPoleTableBand) {
    LayerFacts layer = facts(lmax);
    layer.rays_per_glyph = rays_per_glyph;
    layer.camera_close = camera_close;
    return layer;
}

/// Plans and returns the Error that must come.
Error refusal(const model::FrameRequest& frame, const std::vector<LayerFacts>& layers, const Abilities& abilities = kAll) {
    try {
        planFrame(frame, layers, abilities);
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "no Error was thrown";
    return {Code::kInternal, ""};
}

std::vector<std::string> names(const FramePlan& plan) {
    std::vector<std::string> result;
    for (const PassPlan& pass : plan.passes) result.push_back(pass.name);
    return result;
}

std::vector<std::string> modules(const FramePlan& plan) {
    std::vector<std::string> result;
    for (const PassPlan& pass : plan.passes) result.push_back(pass.shader);
    return result;
}

TEST(PlanTraversal, FollowsDepthComplexityAndAbilities) {
    struct Case {
        double boxes;
        Abilities abilities;
        model::Traversal expected;
        const char* reason;
    };
    const Case cases[] = {
        {kTileDepth, kAll, model::Traversal::kTiles, "about 6.0 boxes along a ray: lists per tile are short"},
        {kTileDepth + 0.1, kAll, model::Traversal::kRayQuery, "about 6.1 boxes along a ray; the device has ray queries"},
        {40, {true, true, true, true}, model::Traversal::kBvh, "a CPU driver, whose ray queries are slower"},
        {40, {true, false, true, true}, model::Traversal::kRayQuery, "the device has ray queries"},
        {40, {false, true, true, false}, model::Traversal::kBvh, "no ray queries on this device"},
        {1, {true, true, false, false}, model::Traversal::kRayQuery, "about 1.0 boxes"},
        {1, {false, true, false, false}, model::Traversal::kBvh, "no ray queries"},
        {40, {false, false, true, false}, model::Traversal::kTiles, "nothing else passed the start-up self-test"},
    };
    for (const Case& c : cases) {
        const FramePlan plan = planFrame(request(), {deep(c.boxes)}, c.abilities);
        EXPECT_EQ(plan.resolved.quality.traversal, c.expected) << c.boxes << " boxes, " << c.reason;
        EXPECT_THAT(plan.traversal_reason, HasSubstr(c.reason));
    }
}

TEST(PlanTraversal, IsOneForAllLayersAndAddsTheirBoxes) {
    const FramePlan plan = planFrame(request(2), {deep(4), deep(4)}, kAll);
    EXPECT_EQ(plan.resolved.quality.traversal, model::Traversal::kRayQuery);
    EXPECT_THAT(plan.traversal_reason, HasSubstr("about 8.0 boxes"));
}

TEST(PlanTraversal, IsTheOneAskedForOrRefused) {
    const std::pair<model::Traversal, const char*> all[] = {
        {model::Traversal::kRayQuery, "ray_query"}, {model::Traversal::kBvh, "bvh"}, {model::Traversal::kTiles, "tiles"}};
    for (const auto& [traversal, name] : all) {
        model::FrameRequest frame = request();
        frame.quality.traversal = traversal;
        const FramePlan plan = planFrame(frame, {deep(1000)}, kAll);
        EXPECT_EQ(plan.resolved.quality.traversal, traversal);
        EXPECT_EQ(plan.traversal_reason, "asked for");
        Abilities without = kAll;
        if (traversal == model::Traversal::kRayQuery) without.ray_query = false;
        if (traversal == model::Traversal::kBvh) without.bvh = false;
        if (traversal == model::Traversal::kTiles) without.tiles = false;
        const Error error = refusal(frame, {facts()}, without);
        EXPECT_EQ(error.code(), Code::kUnsupported);
        EXPECT_THAT(error.what(), AllOf(HasSubstr(std::string("quality.traversal is ") + name), HasSubstr("limits call")));
    }
    EXPECT_EQ(refusal(request(), {facts()}, {false, false, false, false}).code(), Code::kUnavailable);
}

TEST(PlanBands, LimitIsCountedAndRounded) {
    struct Case {
        int data;
        bool full;
        std::optional<int> limit;
        const char* layout;
        std::uint32_t used;
    };
    const Case cases[] = {
        {8, false, {}, "even8", 45}, {8, false, 8, "even8", 45}, {8, false, 4, "even4", 15},    {8, false, 5, "even4", 15},
        {8, false, 1, "even2", 1},   {8, false, 0, "even2", 1},  {0, false, {}, "even2", 1},    {16, false, {}, "even16", 153},
        {8, true, {}, "full8", 81},  {7, true, {}, "full8", 64}, {8, true, 5, "full6", 36},     {8, true, 1, "full2", 4},
        {8, true, 0, "full2", 1},    {1, true, {}, "full2", 4},  {15, true, {}, "full16", 256}, {16, true, {}, "full16", 289},
    };
    for (const Case& c : cases) {
        model::FrameRequest frame = request();
        frame.scene.layers[0].glyphs().lmax = c.limit;
        const FramePlan plan = planFrame(frame, {facts(c.data, c.full)}, kAll);
        EXPECT_EQ(plan.glyphs.at(0).layout_name, c.layout) << c.data << " limited to " << c.limit.value_or(-1);
        EXPECT_EQ(plan.glyphs.at(0).used, c.used) << c.layout << " limited to " << c.limit.value_or(-1);
        EXPECT_EQ(plan.resolved.scene.layers[0].glyphs().lmax, c.limit.value_or(c.data));
    }
}

TEST(PlanBands, LimitAboveTheDataIsRefused) {
    model::FrameRequest frame = request(2);
    frame.scene.layers[1].glyphs().lmax = 9;
    const Error error = refusal(frame, {facts(), facts()});
    EXPECT_EQ(error.code(), Code::kInvalidArgument);
    EXPECT_STREQ(error.what(), "scene.layers[1].glyphs.lmax is 9; the dataset has bands up to 8");
}

TEST(PlanBands, PolynomialDrawsEvenBandsUpToTwelve) {
    model::FrameRequest frame = request();
    frame.quality.intersection = model::Intersection::kPolynomial;
    EXPECT_EQ(planFrame(frame, {facts(12)}, kAll).glyphs.at(0).layout_name, "even12");
    const Error odd = refusal(frame, {facts(4, true)});
    EXPECT_EQ(odd.code(), Code::kUnsupported);
    EXPECT_THAT(odd.what(), AllOf(StartsWith("scene.layers[0].glyphs:"), HasSubstr("odd bands too")));
    const Error high = refusal(frame, {facts(16)});
    EXPECT_EQ(high.code(), Code::kUnsupported);
    EXPECT_THAT(high.what(), AllOf(HasSubstr("bands up to 16"), HasSubstr("set lmax")));
    frame.scene.layers[0].glyphs().lmax = 13;
    EXPECT_EQ(planFrame(frame, {facts(16)}, kAll).glyphs.at(0).layout_name, "even12") << "band 13 is not there";
}

TEST(PlanPoleTable, IsUsedWhereItPays) {
    struct Case {
        model::PoleTable wanted;
        double rays;
        bool close;
        bool used;
        const char* reason;
        int lmax = kPoleTableBand;
    };
    using model::PoleTable;
    const Case cases[] = {
        {PoleTable::kAuto, kPoleTableRays, false, true,
         "on: band 12, about 32.0 rays per glyph; it pays from band 12 and 32.0 rays"},
        {PoleTable::kAuto, 31.9, false, false, "off: band 12, about 31.9 rays per glyph; it pays from band 12 and 32.0 rays"},
        {PoleTable::kAuto, 1000, false, false, "off: band 10, about 1000.0 rays per glyph; it pays from band 12 and 32.0 rays",
         10},
        {PoleTable::kAuto, 1000, true, false, "off: the camera is inside or next to a glyph"},
        {PoleTable::kOn, 0, false, true, "on: asked for"},
        {PoleTable::kOn, 1000, true, false, "off: the camera is inside or next to a glyph"},
        {PoleTable::kOff, 1000, false, false, "off: asked for"},
    };
    for (const Case& c : cases) {
        model::FrameRequest frame = request();
        frame.quality.pole_table = c.wanted;
        const FramePlan plan = planFrame(frame, {withRays(c.rays, c.close, c.lmax)}, kAll);
        EXPECT_EQ(plan.uses_pole_table, c.used) << c.reason;
        EXPECT_EQ(plan.glyphs.at(0).pole_table, c.used) << c.reason;
        EXPECT_EQ(plan.pole_table_reason, c.reason);
        EXPECT_EQ(plan.resolved.quality.pole_table, c.used ? PoleTable::kOn : PoleTable::kOff);
        EXPECT_EQ(names(plan).front(), c.used ? "glyph table" : "glyph trace");
    }
    model::FrameRequest frame = request();
    frame.quality.intersection = model::Intersection::kPolynomial;
    frame.quality.pole_table = PoleTable::kOn;
    const FramePlan plan = planFrame(frame, {withRays(1000)}, kAll);
    EXPECT_FALSE(plan.uses_pole_table);
    EXPECT_EQ(plan.pole_table_reason, "off: the method polynomial has no use for it");
}

TEST(PlanPasses, RunInOrderWithModulesThatExist) {
    const FramePlan one = planFrame(request(), {withRays(40)}, kAll);
    EXPECT_THAT(names(one), ElementsAre("glyph table", "glyph trace", "light", "resolve"));
    EXPECT_THAT(modules(one), ElementsAre("glyph_table_even12", "glyph_trace_even12", "light", "resolve"));
    model::FrameRequest frame = request(2);
    frame.quality.pole_table = model::PoleTable::kOn;
    const FramePlan two = planFrame(frame, {withRays(10, true), withRays(10)}, kAll);
    EXPECT_THAT(names(two), ElementsAre("glyph trace 0", "glyph table 1", "glyph trace 1", "light", "resolve"));
    EXPECT_EQ(two.passes[0].layer, 0);
    EXPECT_EQ(two.passes[1].layer, 1);
    EXPECT_EQ(two.passes[2].layer, 1);
    EXPECT_EQ(two.passes[3].layer, -1);
    for (const bool full : {false, true}) {
        for (int lmax = 0; lmax <= kLmaxLimit; lmax += full ? 1 : 2) {
            for (const auto traversal : {model::Traversal::kRayQuery, model::Traversal::kBvh, model::Traversal::kTiles}) {
                for (const auto method : {model::Intersection::kMarch, model::Intersection::kPolynomial}) {
                    if (method == model::Intersection::kPolynomial && (full || lmax > 12)) continue;
                    frame = request();
                    frame.quality.traversal = traversal;
                    frame.quality.intersection = method;
                    frame.quality.pole_table = model::PoleTable::kOn;
                    for (const std::string& name : modules(planFrame(frame, {facts(lmax, full)}, kAll))) {
                        EXPECT_NO_THROW(shaders::module(name)) << name;
                    }
                }
            }
        }
    }
}

TEST(PlanTensors, AreDrawnByTheirOwnModules) {
    using model::Intersection;
    for (const auto traversal : {model::Traversal::kRayQuery, model::Traversal::kBvh, model::Traversal::kTiles}) {
        for (int order = 2; order <= 12; order += 2) {
            LayerFacts layer = facts(order);
            layer.tensor_order = order;
            for (const auto method : {Intersection::kTensorMarch, Intersection::kTensorInterval, Intersection::kTensorAffine}) {
                model::FrameRequest frame = request();
                frame.quality.traversal = traversal;
                frame.quality.intersection = method;
                const FramePlan plan = planFrame(frame, {layer}, kAll);
                const std::string kind = traversal == model::Traversal::kRayQuery ? "query" : "trace";
                EXPECT_EQ(modules(plan).front(),
                          std::string("glyph_").append(kind).append("_tensor").append(std::to_string(order)));
                EXPECT_FALSE(plan.uses_pole_table);
                EXPECT_NO_THROW(shaders::module(modules(plan).front()));
            }
        }
        LayerFacts layer = facts(2);
        layer.tensor_order = 2;
        model::FrameRequest frame = request();
        frame.quality.traversal = traversal;
        frame.scene.layers[0].glyphs().tensor = model::TensorShape::kEllipsoid;
        EXPECT_NO_THROW(shaders::module(modules(planFrame(frame, {layer}, kAll)).front()));
        // Through their bands where no tensor method was asked for.
        frame.scene.layers[0].glyphs().tensor = model::TensorShape::kReynolds;
        EXPECT_THAT(modules(planFrame(frame, {layer}, kAll)).back(), "resolve");
        EXPECT_THAT(planFrame(frame, {layer}, kAll).glyphs[0].layout_name, "even2");
    }
    model::FrameRequest frame = request();
    frame.quality.intersection = Intersection::kTensorMarch;
    LayerFacts odd = facts(3, true);
    odd.tensor_order = 3;
    const Error error = refusal(frame, {odd});
    EXPECT_EQ(error.code(), Code::kUnsupported);
    EXPECT_THAT(error.what(), HasSubstr("tensor-march draws tensors of even order 2 to 12"));
}

TEST(PlanFrame, ResolvedRequestPlansToItself) {
    for (const auto& layers : {std::vector{withRays(100), withRays(0.5)}, std::vector{withRays(0.5), withRays(100)},
                               std::vector{withRays(100, true), withRays(100)}, std::vector{withRays(1), withRays(1)}}) {
        model::FrameRequest frame = request(2);
        frame.scene.layers[1].glyphs().negative_lobes = model::NegativeLobes::kShown;
        const FramePlan first = planFrame(frame, layers, kAll);
        const FramePlan again = planFrame(first.resolved, layers, kAll);
        EXPECT_EQ(again.resolved, first.resolved);
        EXPECT_EQ(modules(again), modules(first));
        EXPECT_FALSE(first.glyphs[0].both_lobes);
        EXPECT_TRUE(first.glyphs[1].both_lobes);
    }
}

TEST(PlanColour, OpenRangesAreFilledInAndModesCompiledAreThoseInUse) {
    model::FrameRequest frame = request(3);
    std::vector<LayerFacts> layers(3, facts());
    EXPECT_EQ(planFrame(frame, layers, kAll).colour_modes, 1U);
    model::GlyphColour& radius = frame.scene.layers[1].glyphs().colour;
    radius.mode = model::ColourMode::kRadius;
    layers[1].radius_typical_mm = 1.5;
    model::GlyphColour& scalar = frame.scene.layers[2].glyphs().colour;
    scalar.mode = model::ColourMode::kScalar;
    scalar.image_id = "fa";
    layers[2].value_min = -2;
    layers[2].value_max = 8;
    const FramePlan plan = planFrame(frame, layers, kAll);
    EXPECT_EQ(plan.colour_modes, 0b111U);
    EXPECT_FALSE(plan.resolved.scene.layers[0].glyphs().colour.range);
    EXPECT_EQ(plan.resolved.scene.layers[1].glyphs().colour.range, (model::ColourRange{0, 1.5F}));
    EXPECT_EQ(plan.resolved.scene.layers[2].glyphs().colour.range, (model::ColourRange{-2, 8}));
    EXPECT_EQ(planFrame(plan.resolved, layers, kAll).resolved, plan.resolved);
    layers[2].value_max = -2;  // one value only
    EXPECT_EQ(planFrame(frame, layers, kAll).resolved.scene.layers[2].glyphs().colour.range, (model::ColourRange{-2, 0}));
    scalar.range = model::ColourRange{0, 1};
    EXPECT_EQ(planFrame(frame, layers, kAll).resolved.scene.layers[2].glyphs().colour.range, (model::ColourRange{0, 1}));
}

}  // namespace
}  // namespace radiata::plan
