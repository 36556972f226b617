// Generated values, gradients and ranges of Cartesian tensors against their twin in double.
#include <algorithm>
#include <cmath>

#include "gpu/functions/tensor_runner.h"
#include "reference/tensor_function.h"
#include "shaders/test/tensor_io.glsl"

namespace radiata::test {
namespace {

using shader::PieceInput;
using shader::PieceOutput;
using shader::TensorValue;

class TensorFunctions : public TensorTest {};

glm::vec3 randomPoint(std::mt19937& random) {
    std::uniform_real_distribution<float> unit(-1, 1);
    return glm::vec3(unit(random), unit(random), unit(random));
}

double sumOfTerms(int order, const std::vector<float>& components) {
    double sum = 0;
    std::size_t i = 0;
    for (const TensorPowers powers : symmetricComponents(order)) {
        sum += multiplicity(powers) * std::abs(static_cast<double>(components[i++]));
    }
    return sum;
}

TEST_F(TensorFunctions, ValuesAndGradientsAgreeWithTheirTwin) {
    std::mt19937 random(21);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (const int order : {2, 3, 4, 5, 8, 12}) {
        std::vector<float> shared(symmetricCount(order));
        for (float& value : shared) value = unit(random);
        const reference::TensorFunction f(order, std::span<const float>(shared));
        const double scale = sumOfTerms(order, shared);
        if (order <= 4) shared.resize(shared.size() + entryCount(order));
        std::vector<glm::vec3> points(order == 12 ? 20 : 200);
        for (glm::vec3& p : points) p = randomPoint(random);
        const auto values = runFunction<TensorValue>("test_tensor_value" + std::to_string(order), {}, points, shared);
        double worst = 0, worst_slope = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double value = f(points[i]);
            worst = std::max({worst, std::abs(values[i].value - value), std::abs(values[i].alone - value)});
            worst_slope = std::max(worst_slope, glm::length(glm::dvec3(values[i].gradient) - f.gradient(points[i])));
        }
        std::printf("order %2d: value %.1e, gradient %.1e of the sum of terms\n", order, worst / scale, worst_slope / scale);
        EXPECT_LT(worst, 1e-6 * scale) << order;
        EXPECT_LT(worst_slope, 2e-6 * order * scale) << order;
    }
}

TEST_F(TensorFunctions, TensorsWithoutSymmetryAreTheirSymmetricPart) {
    // Eq. 4 over all entries as they are, Eq. 5 over the components of the mean.
    std::mt19937 random(22);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const int order : {2, 3, 4}) {
        std::vector<double> entries(entryCount(order));
        for (double& value : entries) value = unit(random);
        const std::vector<double> components = symmetricPart(order, entries);
        std::vector<float> shared(components.begin(), components.end());
        shared.insert(shared.end(), entries.begin(), entries.end());
        std::vector<glm::vec3> points(200);
        for (glm::vec3& p : points) p = randomPoint(random);
        for (const TensorValue& value :
             runFunction<TensorValue>("test_tensor_value" + std::to_string(order), {}, points, shared)) {
            EXPECT_NEAR(value.alone, value.from_entries, 1e-6 * static_cast<double>(entries.size()));
        }
    }
}

TEST_F(TensorFunctions, RangesHoldEveryValueAndAffineOnesAreNarrower) {
    std::mt19937 random(23);
    std::uniform_real_distribution<float> unit(0, 1);
    for (const int order : {2, 3, 4, 12}) {
        const TensorGlyph glyph = randomTensorGlyph(random, order);
        const reference::ShFunction f(glyph.layout, glyph.coefficients);  // homogeneous: f(p) = |p|^n f(p / |p|)
        const std::vector<RayInput> rays = randomRays(random, 300, 0.0F, 0.9F);
        std::vector<PieceInput> pieces;
        for (const RayInput& ray : rays) {
            const float low = -0.9F + 1.6F * unit(random);
            pieces.push_back({ray.origin, low, ray.direction, low + 0.1F * unit(random)});
        }
        const auto outputs =
            runFunction<PieceOutput>("test_tensor_range" + std::to_string(order), {}, pieces, glyph.components);
        const double slack = 2e-6 * (1 + sumOfTerms(order, glyph.components));  // kRangeSlack at distance 1
        double interval_width = 0, affine_width = 0;
        int outside = 0;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            const glm::dvec3 d = glm::normalize(glm::dvec3(pieces[i].direction)), o(pieces[i].origin);
            const glm::dvec3 foot = o - glm::dot(o, d) * d;
            const PieceOutput& out = outputs[i];
            for (int n = 0; n <= 40; ++n) {
                const double low = pieces[i].low, s = low + (static_cast<double>(pieces[i].high) - low) * n / 40;
                const glm::dvec3 p = foot + s * d;
                const double value = f(p) * std::pow(glm::length(p), order), power = std::pow(glm::length(p), order + 1);
                const auto within = [&](const glm::vec2& range, double x) {
                    return x >= range.x - slack && x <= range.y + slack;
                };
                outside += !within(out.interval_difference, value - power) || !within(out.interval_sum, value + power);
                outside += !within(out.affine_difference, value - power) || !within(out.affine_sum, value + power);
            }
            interval_width += static_cast<double>(out.interval_difference.y - out.interval_difference.x);
            affine_width += static_cast<double>(out.affine_difference.y - out.affine_difference.x);
        }
        std::printf("order %2d: mean width of intervals %.3g, of affine forms %.3g\n", order, interval_width / 300,
                    affine_width / 300);
        EXPECT_EQ(outside, 0) << order;
        EXPECT_LT(affine_width, interval_width) << order;
    }
}

}  // namespace
}  // namespace radiata::test
