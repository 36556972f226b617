#include <string>

#include "gpu/functions/function_runner.h"
#include "gpu/functions/ray_comparison.h"
#include "reference/sh_function.h"

namespace radiata {
namespace {

using ShBasisFunctions = test::FunctionTest;

/// As in shaders/test/sh_basis.comp.
struct ShValues {
    glm::vec3 slope;
    float value, other_value;
};

TEST_F(ShBasisFunctions, GeneratedCodeAgreesWithItsTwin) {
    std::mt19937 random(15);
    std::normal_distribution<float> normal;
    for (const ShLayout layout :
         {ShLayout{2, false}, ShLayout{8, false}, ShLayout{16, false}, ShLayout{4, true}, ShLayout{16, true}}) {
        const std::vector<float> glyph = test::randomGlyph(random, layout);
        const reference::ShFunction f(layout, glyph);
        double sum = 0;
        for (const float c : glyph) sum += std::abs(c);
        std::vector<glm::vec3> directions{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}};
        while (directions.size() < 500) {
            directions.push_back(glm::normalize(glm::vec3(normal(random), normal(random), normal(random))));
        }
        const std::string name = (layout.full ? "full" : "even") + std::to_string(layout.lmax);
        const auto outputs = runFunction<ShValues>("test_sh_basis_" + name, {}, directions, glyph);
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const glm::dvec3 p = glm::normalize(glm::dvec3(directions[i]));
            EXPECT_NEAR(outputs[i].value, f(p), 2e-6 * sum) << name;
            EXPECT_NEAR(outputs[i].other_value, f(p), 2e-6 * sum) << name;
            const glm::dvec3 slope(outputs[i].slope);
            EXPECT_LT(glm::length(slope - glm::dot(slope, p) * p - f.gradient(p)), 2e-6 * sum * (1 + layout.lmax)) << name;
        }
    }
}

}  // namespace
}  // namespace radiata
