// Methods of intersection: what each draws and refuses, that its modules exist, and what they are compiled with.
#include "plan/method_plan.h"

#include <bit>

#include <gmock/gmock.h>

#include "base/error.h"
#include "plan/tensor_methods.h"
#include "shaders/modules.h"

namespace radiata::plan {
namespace {

using model::Intersection;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Abilities able() {
    Abilities abilities;
    abilities.ray_query = abilities.float64 = true;
    return abilities;
}

model::FrameRequest request(Intersection method) {
    model::FrameRequest frame;
    frame.scene.layers.resize(1);
    frame.scene.layers[0].glyphs().dataset_id = "any";
    frame.quality.intersection = method;
    return frame;
}

LayerFacts facts(int lmax, bool full = false, bool odd_bands_only = false) {
    LayerFacts layer;
    layer.layout = {lmax, full};
    layer.glyphs = layer.glyphs_available = 100;
    layer.rays_per_glyph = 100;
    layer.odd_bands_only = odd_bands_only;
    return layer;
}

std::string refusal(const model::FrameRequest& frame, const LayerFacts& layer, const Abilities& abilities) {
    try {
        planFrame(frame, {layer}, abilities);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), Code::kUnsupported);
        return error.what();
    }
    return "";
}

TEST(MethodPlan, EveryMethodHasModulesForWhatItDraws) {
    for (const model::MethodName& row : model::kMethodNames) {
        if (drawsTensors(row.method) || row.method == Intersection::kTessellated) continue;
        const bool any = model::marches(row.method);
        const bool four = row.method == Intersection::kPolynomialDouble || row.method == Intersection::kLaguerre;
        for (int lmax = 0; lmax <= 16; ++lmax) {
            for (const int kind : {0, 1, 2}) {  // even, both parities, odd only
                if (kind == 0 && lmax % 2) continue;
                const LayerFacts layer = facts(lmax, kind > 0, kind == 2);
                const bool odd = row.method == Intersection::kPolynomial && kind == 2;
                const bool drawn = any || ((kind == 0 || odd) && lmax <= (four ? 4 : 12));
                for (const auto traversal : {model::Traversal::kRayQuery, model::Traversal::kBvh, model::Traversal::kTiles}) {
                    model::FrameRequest frame = request(row.method);
                    frame.quality.traversal = traversal;
                    if (!drawn) {
                        EXPECT_THAT(refusal(frame, layer, able()), HasSubstr("the method " + std::string(row.name)));
                        continue;
                    }
                    const FramePlan plan = planFrame(frame, {layer}, able());
                    for (const PassPlan& pass : plan.passes) EXPECT_NO_THROW(shaders::module(pass.shader)) << pass.shader;
                    EXPECT_EQ(planFrame(plan.resolved, {layer}, able()).resolved, plan.resolved) << row.name;
                }
            }
        }
    }
}

TEST(MethodPlan, SettingsAreCompiledIn) {
    const auto constants = [](const model::FrameRequest& frame) {
        return planFrame(frame, {facts(4)}, able()).glyphs.at(0).method_constants;
    };
    const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
    EXPECT_THAT(constants(request(Intersection::kMarch)), ElementsAre());
    model::FrameRequest frame = request(Intersection::kPolynomial);
    EXPECT_THAT(constants(frame), ElementsAre(1, bits(1e-6F)));
    frame.quality.polynomial.bracket_stop = false;
    EXPECT_THAT(constants(frame), ElementsAre(0, bits(2e-4F)));
    frame.quality.polynomial.tolerance = 0.01;
    EXPECT_THAT(constants(frame), ElementsAre(0, bits(0.01F)));
    EXPECT_THAT(constants(request(Intersection::kPolynomialDouble)), ElementsAre(1, bits(1e-12F)));
    EXPECT_THAT(constants(request(Intersection::kLaguerre)), ElementsAre(bits(1e-3F)));
    EXPECT_THAT(constants(request(Intersection::kRayMarchPeeters)), ElementsAre(0, 100, 10));
    frame = request(Intersection::kRayMarchVanAlmsick);
    frame.quality.ray_march.steps = 200;
    EXPECT_THAT(constants(frame), ElementsAre(1, 200, 4));
    frame.quality.ray_march.refinements = 0;
    EXPECT_THAT(constants(frame), ElementsAre(1, 200, 0));
}

TEST(MethodPlan, TablesAreThoseOfTheMethod) {
    FramePlan plan = planFrame(request(Intersection::kRayMarchVanAlmsick), {facts(4)}, able());
    EXPECT_EQ(plan.passes.at(0).shader, "glyph_van_almsick_table_even4");
    EXPECT_EQ(plan.glyphs.at(0).table_floats, 17U) << "15 coefficients, radius and half length of the cylinder";
    plan = planFrame(request(Intersection::kPoleTable), {facts(4)}, able());
    EXPECT_EQ(plan.passes.at(0).shader, "glyph_table_even4");
    EXPECT_EQ(plan.glyphs.at(0).table_floats, 23U);
    EXPECT_EQ(plan.resolved.quality.intersection, Intersection::kPoleTable);
    LayerFacts close = facts(4);
    close.camera_close = true;
    plan = planFrame(request(Intersection::kPoleTable), {close}, able());
    EXPECT_FALSE(plan.uses_pole_table);
    EXPECT_EQ(plan.resolved.quality.intersection, Intersection::kMarch) << "what it was resolved to";
    plan = planFrame(request(Intersection::kRayMarchPeeters), {facts(4)}, able());
    EXPECT_EQ(plan.pole_table_reason, "off: the method ray-march-peeters has no use for it");
}

TEST(MethodPlan, DoubleNeedsTheDevice) {
    Abilities abilities = able();
    abilities.float64 = false;
    EXPECT_THAT(refusal(request(Intersection::kPolynomialDouble), facts(4), abilities), HasSubstr("double precision"));
}

}  // namespace
}  // namespace radiata::plan
