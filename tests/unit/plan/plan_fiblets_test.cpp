// Which pipeline draws fibres, and what a device must have for it.
#include <gtest/gtest.h>

#include "base/error.h"
#include "plan/plan.h"
#include "plan/plan_peels.h"

namespace radiata::plan {
namespace {

using Pipeline = model::FibletPipeline;

Abilities everything() {
    Abilities all;
    all.int64_atomics = all.raster = all.lines = true;
    all.mesh_shader = all.mesh_subgroups = all.geometry_shader = all.tessellation_shader = true;
    all.line_width_max = 8;
    return all;
}

FramePlan planOf(Pipeline pipeline, const Abilities& abilities, int line_width_px = 1, bool tubes = false) {
    model::FrameRequest request;
    request.quality.fiblet_pipeline = pipeline;
    model::TractogramLayer layer;
    layer.line_width_px = line_width_px;
    if (tubes) layer.tube_radius_mm = 1.0F;
    request.scene.layers.emplace_back().content = layer;
    return planFrame(request, {LayerFacts{}}, abilities);
}

/// What the refusal says, or nothing.
std::string refusal(Pipeline pipeline, const Abilities& abilities, int line_width_px = 1, bool tubes = false) {
    try {
        planOf(pipeline, abilities, line_width_px, tubes);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), Code::kUnsupported);
        return error.what();
    }
    return "";
}

TEST(PlanFiblets, DrawByAtomicsAndByTheRasteriserWithoutThem) {
    Abilities abilities = everything();
    EXPECT_EQ(planOf(Pipeline::kAuto, abilities).resolved.quality.fiblet_pipeline, Pipeline::kAtomic);
    EXPECT_EQ(planOf(Pipeline::kAuto, abilities).fiblets[0]->pipeline, Pipeline::kAtomic);
    abilities.failed_pipelines = 1U << static_cast<unsigned>(Pipeline::kAtomic);
    EXPECT_EQ(planOf(Pipeline::kAuto, abilities).resolved.quality.fiblet_pipeline, Pipeline::kPull);
    abilities.failed_pipelines = 0;
    abilities.int64_atomics = false;
    EXPECT_EQ(planOf(Pipeline::kAuto, abilities).resolved.quality.fiblet_pipeline, Pipeline::kPull);
    EXPECT_NE(refusal(Pipeline::kAtomic, abilities).find("64-bit atomics"), std::string::npos);
    EXPECT_NE(refusal(Pipeline::kPull, abilities, 1, true).find("for tubes"), std::string::npos);
}

TEST(PlanFiblets, RefuseWhatTheDeviceLacksOrGetsWrong) {
    Abilities abilities = everything();
    for (const Pipeline pipeline : {Pipeline::kAtomic, Pipeline::kPull, Pipeline::kMesh, Pipeline::kMeshSerial,
                                    Pipeline::kGeometry, Pipeline::kTessellation, Pipeline::kLines, Pipeline::kPoints}) {
        EXPECT_EQ(refusal(pipeline, abilities), "");
        abilities.failed_pipelines = 1U << static_cast<unsigned>(pipeline);
        EXPECT_NE(refusal(pipeline, abilities).find(std::string(model::pipelineName(pipeline)) + ", whose self-test"),
                  std::string::npos);
        abilities.failed_pipelines = 0;
    }
    EXPECT_NE(refusal(Pipeline::kLines, abilities, 9).find("at most 8"), std::string::npos);
    abilities.mesh_shader = abilities.geometry_shader = abilities.tessellation_shader = false;
    EXPECT_NE(refusal(Pipeline::kMesh, abilities).find("task and mesh shaders"), std::string::npos);
    EXPECT_NE(refusal(Pipeline::kMeshSerial, abilities).find("task and mesh shaders"), std::string::npos);
    EXPECT_NE(refusal(Pipeline::kGeometry, abilities).find("geometry shaders"), std::string::npos);
    EXPECT_NE(refusal(Pipeline::kTessellation, abilities).find("tessellation shaders"), std::string::npos);
    abilities.lines = false;
    EXPECT_NE(refusal(Pipeline::kPull, abilities).find("rasteriser of lines"), std::string::npos);
}

TEST(PlanFiblets, CullNothingOfUncompressedPoints) {
    EXPECT_EQ(planOf(Pipeline::kLines, everything()).resolved.quality.fiblet_culling, model::FibletCulling::kNone);
    EXPECT_EQ(planOf(Pipeline::kPoints, everything()).resolved.quality.fiblet_culling, model::FibletCulling::kNone);
    EXPECT_EQ(planOf(Pipeline::kMesh, everything()).resolved.quality.fiblet_culling, model::FibletCulling::kTwoPhase);
}

/// Two phases where there is much behind something or the picture is small; else what is in the picture, and the frame says so.
/// What is asked for by name is done.
TEST(PlanFiblets, LookForWhatIsHiddenWhereThatPays) {
    using Culling = model::FibletCulling;
    const auto plan = [](std::uint64_t fiblets, int height, Culling asked = Culling::kAuto, Pipeline pipeline = Pipeline::kAuto,
                         bool frozen = false) {
        model::FrameRequest request;
        request.width = 16 * height / 9;
        request.height = height;
        request.quality.fiblet_pipeline = pipeline;
        request.quality.fiblet_culling = asked;
        if (frozen) request.quality.frozen_culling = request.camera;
        request.scene.layers.emplace_back().content = model::TractogramLayer{};
        LayerFacts facts;
        facts.fiblets = fiblets;
        const FramePlan made = planFrame(request, {facts}, everything());
        EXPECT_EQ(made.resolved.quality.fiblet_culling, made.fiblets[0]->culling);
        return made.fiblets[0]->culling;
    };
    EXPECT_EQ(plan(150'000, 720), Culling::kFrustum);
    EXPECT_EQ(plan(1'500'000, 720), Culling::kTwoPhase);
    EXPECT_EQ(plan(1'500'000, 2160), Culling::kFrustum);
    EXPECT_EQ(plan(100, 240), Culling::kTwoPhase) << "pyramids of small pictures cost nothing";
    EXPECT_EQ(plan(150'000, 720, Culling::kNone), Culling::kNone);
    EXPECT_EQ(plan(1'500'000, 720, Culling::kFrustum), Culling::kFrustum);
    EXPECT_EQ(plan(150'000, 720, Culling::kCoverage), Culling::kCoverage);
    EXPECT_EQ(plan(150'000, 720, Culling::kTwoPhase), Culling::kTwoPhase) << "by name";
    EXPECT_EQ(plan(1'500'000, 2160, Culling::kTwoPhase), Culling::kTwoPhase) << "by name";
    EXPECT_EQ(plan(150'000, 720, Culling::kAuto, Pipeline::kMesh), Culling::kTwoPhase) << "decoding costs more there";
    EXPECT_EQ(plan(150'000, 720, Culling::kAuto, Pipeline::kAuto, true), Culling::kTwoPhase) << "frozen";
}

/// One for the frame: what it says plans to the same again. A transparent layer hides nothing, whatever is asked for.
TEST(PlanFiblets, CullAllLayersAlike) {
    using Culling = model::FibletCulling;
    model::FrameRequest request;
    request.scene.layers.resize(3);
    for (model::Layer& layer : request.scene.layers) layer.content = model::TractogramLayer{};
    request.scene.layers[2].opacity = 0.5F;
    std::vector<LayerFacts> facts(3);
    facts[0].fiblets = 100;
    facts[1].fiblets = facts[2].fiblets = 1'500'000;
    FramePlan made = planFrame(request, facts, everything());
    EXPECT_EQ(made.resolved.quality.fiblet_culling, Culling::kTwoPhase);
    EXPECT_EQ(made.fiblets[0]->culling, Culling::kTwoPhase);
    EXPECT_EQ(made.fiblets[1]->culling, Culling::kTwoPhase);
    EXPECT_EQ(made.fiblets[2]->culling, Culling::kFrustum);
    EXPECT_EQ(planFrame(made.resolved, facts, everything()).fiblets[0]->culling, Culling::kTwoPhase);
    facts[1].fiblets = 100;
    made = planFrame(request, facts, everything());
    EXPECT_EQ(made.resolved.quality.fiblet_culling, Culling::kFrustum) << "what is transparent does not ask for it";
    EXPECT_EQ(made.fiblets[1]->culling, Culling::kFrustum);
    request.quality.fiblet_culling = Culling::kTwoPhase;
    made = planFrame(request, facts, everything());
    EXPECT_EQ(made.resolved.quality.fiblet_culling, Culling::kTwoPhase);
    EXPECT_EQ(made.fiblets[0]->culling, Culling::kTwoPhase);
    EXPECT_EQ(made.fiblets[2]->culling, Culling::kFrustum);
}

/// Segments that pixels keep of transparent layers: 16 bytes each, 256 MiB of all layers.
TEST(PlanFiblets, KeepAsManySegmentsAsFit) {
    EXPECT_EQ(peelSlots(500 * 400, 1, 8), 8U);
    EXPECT_EQ(peelSlots(1920 * 1080, 1, 8), 8U);
    EXPECT_EQ(peelSlots(1920 * 1080, 2, 8), 4U);
    EXPECT_EQ(peelSlots(1920 * 1080, 3, 8), 2U);
    EXPECT_EQ(peelSlots(1920 * 1080, 1, 4), 4U);
    EXPECT_EQ(peelSlots(16'777'216, 8, 8), 1U) << "one is what it takes";
    EXPECT_EQ(peelSlots(1, 0, 8), 8U);
}

}  // namespace
}  // namespace radiata::plan
