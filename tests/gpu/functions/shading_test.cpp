#include "reference/shading.h"

#include <cmath>
#include <random>

#include "gpu/functions/function_runner.h"
#include "reference/illuminated_line.h"
#include "reference/phong.h"
#include "shaders/test/shading_io.glsl"

namespace radiata {
namespace {

using shader::ShadingInput;
using shader::ShadingOutput;
using ShadingFunctions = test::FunctionTest;

std::vector<ShadingInput> randomInputs(std::size_t count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0, 1);
    std::normal_distribution<float> normal;
    const auto direction = [&] { return glm::normalize(glm::vec3(normal(random), normal(random), normal(random))); };
    std::vector<ShadingInput> inputs(count);
    for (ShadingInput& x : inputs) {
        x = {{unit(random), unit(random), unit(random)},
             0.2F + 0.8F * unit(random),
             direction(),
             3 * unit(random),
             direction(),
             unit(random),
             direction(),
             0};
        if (glm::dot(x.normal, x.viewer) < 0) x.viewer = -x.viewer;
    }
    inputs[0].light = inputs[0].viewer = inputs[0].normal;  // head-on
    inputs[1].light = -inputs[1].normal;
    return inputs;
}

TEST_F(ShadingFunctions, BrdfAgreesWithItsTwin) {
    const std::vector<ShadingInput> inputs = randomInputs(20000);
    const auto outputs = runFunction<ShadingOutput>("test_shading", {}, inputs);
    double worst = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const ShadingInput& x = inputs[i];
        // At the very horizon of viewer or light the answer hangs on the rounding of a cosine.
        if (std::abs(glm::dot(x.normal, x.light)) < 1e-3F || glm::length(x.viewer + x.light) < 1e-3F) continue;
        const glm::dvec3 expected =
            reference::shadeDielectric(x.base, x.roughness, x.normal, x.viewer, x.light, x.irradiance, x.ambient);
        const glm::dvec3 difference = glm::abs(glm::dvec3(outputs[i].radiance) - expected);
        for (int c = 0; c < 3; ++c) worst = std::max(worst, difference[c] / (0.01 + expected[c]));
    }
    EXPECT_LT(worst, 2e-3);
    RecordProperty("worst", std::to_string(worst));
}

/// 2e-3 of the value and a hundredth.
TEST_F(ShadingFunctions, IlluminatedLinesAgreeWithTheirTwin) {
    const std::vector<ShadingInput> inputs = randomInputs(5000);
    const auto outputs = runFunction<ShadingOutput>("test_shading", {}, inputs);
    double worst = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const ShadingInput& x = inputs[i];
        // Along the line, and with the light behind it, the answer hangs on the rounding of a cosine.
        if (std::abs(glm::dot(x.normal, x.viewer)) > 0.9999F || std::abs(glm::dot(x.normal, x.light)) > 0.9999F ||
            glm::length(x.viewer + x.light) < 1e-2F) {
            continue;
        }
        const glm::dvec3 expected = reference::illuminatedLine(x.base, x.roughness, x.normal, x.viewer, x.light);
        const glm::dvec3 difference = glm::abs(glm::dvec3(outputs[i].line) - expected);
        for (int c = 0; c < 3; ++c) worst = std::max(worst, difference[c] / (0.01 + expected[c]));
    }
    EXPECT_LT(worst, 2e-3);
}

/// 1e-4 of the value and a hundredth: angles in double against products of cosines in float, to the 30th power.
TEST_F(ShadingFunctions, LambertAndPhongAgreeWithTheirTwins) {
    const std::vector<ShadingInput> inputs = randomInputs(20000);
    const auto outputs = runFunction<ShadingOutput>("test_shading", {}, inputs);
    double worst = 0;
    int highlights = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const ShadingInput& x = inputs[i];
        if (std::abs(glm::dot(x.normal, x.light)) < 1e-5F) continue;
        const glm::dvec3 phong = reference::phongReflection(x.base, x.normal, x.viewer, x.light);
        const glm::dvec3 lambert = reference::lambertReflection(x.base, x.normal, x.light);
        highlights += phong.x > lambert.x + 0.01;
        for (int c = 0; c < 3; ++c) {
            worst = std::max(worst, std::abs(static_cast<double>(outputs[i].phong[c]) - phong[c]) / (0.01 + phong[c]));
            worst = std::max(worst, std::abs(static_cast<double>(outputs[i].lambert[c]) - lambert[c]) / (0.01 + lambert[c]));
        }
        EXPECT_NEAR(outputs[i].ambient, reference::varyingAmbient(x.normal, x.light), 1e-6);
    }
    EXPECT_LT(worst, 1e-4);
    EXPECT_GT(highlights, 200);
}

TEST_F(ShadingFunctions, TransferCurvesAgreeWithTheirTwins) {
    std::vector<ShadingInput> inputs = randomInputs(20000);
    inputs[0].base = {0, 1, 0.0031308F};
    inputs[1].base = {-1, 2, 0.04045F};
    inputs[2].base = {1e-8F, 0.00313F, 0.00314F};
    const auto outputs = runFunction<ShadingOutput>("test_shading", {}, inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double x = inputs[i].base[c];
            EXPECT_NEAR(outputs[i].srgb[c], reference::srgbFromLinear(x), 2e-5) << x;
            EXPECT_NEAR(outputs[i].linear[c], reference::linearFromSrgb(x), 2e-5) << x;
        }
    }
}

}  // namespace
}  // namespace radiata
