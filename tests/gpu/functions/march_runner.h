// The march on the device: directly, and from pole-frame tables.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "build/bounds.h"
#include "gpu/functions/function_runner.h"
#include "gpu/functions/ray_comparison.h"

namespace radiata::test {

inline std::string nameOf(ShLayout layout) { return (layout.full ? "full" : "even") + std::to_string(layout.lmax); }

/// What the renderer takes: certified, a few per cent larger than the glyph.
inline float certifiedRadius(const BoundsEvaluator& evaluator, const std::vector<float>& glyph) {
    std::vector<GlyphBounds> bounds(1);
    evaluator.evaluate(glyph, true, bounds);
    return bounds[0].radius;
}

class MarchTest : public FunctionTest {
protected:
    std::vector<RayOutput> march(ShLayout layout, const std::vector<float>& glyph, float radius,
                                 const std::vector<RayInput>& rays, bool may_give_up = false) {
        std::vector<float> shared = glyph;
        shared.push_back(radius);
        const auto outputs = runFunction<RayOutput>("test_march_" + nameOf(layout), {0}, rays, shared);
        return may_give_up ? outputs : checked(outputs);
    }

    /// \param pole_and_table  an output of test_pole_table
    std::vector<RayOutput> marchFromTable(ShLayout layout, const std::vector<float>& glyph, float radius,
                                          const std::vector<float>& pole_and_table, const std::vector<RayInput>& rays) {
        std::vector<float> shared = glyph;
        shared.push_back(radius);
        shared.insert(shared.end(), pole_and_table.begin(), pole_and_table.end());
        return checked(runFunction<RayOutput>("test_march_" + nameOf(layout), {1}, rays, shared));
    }

    /// Normals on the device in the directions of the hits.
    std::vector<glm::vec3> normals(ShLayout layout, const std::vector<float>& glyph, const std::vector<RayOutput>& hits) {
        std::vector<glm::vec3> directions;
        for (const RayOutput& hit : hits) directions.push_back(hit.direction);
        return runFunction<glm::vec3>("test_glyph_normal_" + nameOf(layout), {}, directions, glyph);
    }

private:
    static std::vector<RayOutput> checked(std::vector<RayOutput> outputs) {
        for (const RayOutput& output : outputs) EXPECT_EQ(output.count, 0U) << "gave up";
        return outputs;
    }
};

}  // namespace radiata::test
