// The march against the exhaustive search; no miss is allowed. Measured over 72,000 rays: worst error 1.2e-5 where the first
// hit is well conditioned, 1.2e-4 at the centre.
#include "gpu/functions/march_runner.h"
#include "reference/glyph_bounds.h"

namespace radiata {
namespace {

using namespace test;

const std::vector<ShLayout> kLayouts{{2, false},  {4, false}, {8, false}, {12, false},
                                     {16, false}, {4, true},  {8, true},  {16, true}};

class MarchFunctions : public MarchTest {
protected:
    Solve solver(ShLayout layout) {
        return [this, layout](const std::vector<float>& glyph, const std::vector<RayInput>& rays) {
            const double radius = reference::glyphBounds(reference::ShFunction(layout, glyph), true).radius;
            return march(layout, glyph, float(radius * (1 + 1e-6)), rays);
        };
    }
};

TEST_F(MarchFunctions, IsRightOverTheWholeGlyph) {
    for (const ShLayout layout : kLayouts) {
        EXPECT_EQ(compareRegion(solver(layout), layout, {0, 1}, 2e-5).wrong, 0) << nameOf(layout);
    }
}

TEST_F(MarchFunctions, IsRightAtTheCentre) {
    // The bound is larger because a first hit there may move up to 1e-3 radii when the ray moves by 1e-5, and float32 moves it
    // by 1e-7.
    for (const ShLayout layout : kLayouts) {
        for (const Region region : {Region{0, 0.02F}, Region{0, 2e-4F}}) {
            EXPECT_EQ(compareRegion(solver(layout), layout, region, 3e-4).wrong, 0) << nameOf(layout);
        }
    }
}

TEST_F(MarchFunctions, StartsAtTheFirstParameterAllowed) {
    for (const ShLayout layout : kLayouts) {
        EXPECT_LE(compareRegion(solver(layout), layout, {0.02F, 0.5F}, 2e-5, true).wrong, 1) << nameOf(layout);
    }
}

}  // namespace
}  // namespace radiata
