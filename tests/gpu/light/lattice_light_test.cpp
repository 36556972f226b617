// Texels against path tracing in double by other means, and against each other.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gpu/light/lattice_fixture.h"
#include "reference/path_tracer.h"

namespace radiata {
namespace {

constexpr double kPi = std::numbers::pi;

/// A ball with a bite out of its top: some of it sees itself.
double bitten(const glm::dvec3& p) {
    return std::min(6.3 - glm::length(p - 8.5), glm::length(p - glm::dvec3(8.5, 8.5, 13)) - 4.6);
}

class LatticeLight : public test::LatticeTest {
protected:
    const glm::ivec3 size_{18};
    model::ScalarImage image_ = image(size_, bitten);
    reference::ScalarField field_{size_, std::vector<double>(image_.values.begin(), image_.values.end())};
    /// Texels on the wall of the bite and on the outside.
    const std::vector<glm::ivec3> texels_{{8, 8, 8}, {6, 9, 9}, {10, 7, 9}, {8, 5, 11}, {3, 8, 8}, {8, 12, 5}, {12, 10, 10}};

    model::Illumination settings() const {
        model::Illumination light;
        light.storage = model::TexelStorage::kFloat32;
        light.bounces = 2;
        light.orders = {5, 3, 2, 2, 2};
        light.relative_error = 1e-6F;
        light.samples_max = 512;
        light.sky = {glm::vec3(0.8F), glm::vec3(0.5F), {0.2, -0.3, 1}};
        return light;
    }
    double sky(const model::Illumination& light, const glm::dvec3& d) const {
        return light.sky.radiance.x + light.sky.gradient.x * glm::dot(d, glm::normalize(light.sky.up));
    }
    double isovalueOf(const glm::ivec3& texel) const { return field_.value(glm::dvec3(texel)) + 1e-5 * range(); }
    double range() const { return *std::ranges::max_element(image_.values) - *std::ranges::min_element(image_.values); }
};

TEST_F(LatticeLight, IrradianceAgreesWithPathTracingInDouble) {
    model::Illumination light = settings();
    light.suns.push_back({{0.3, 0.2, 1}, 30, glm::vec3(2)});
    light.lights.push_back({{8.5, 8.5, 15}, 0, glm::vec3(20)});
    const auto lattice = full(volume(image_), light);
    const glm::dvec3 sun = glm::normalize(light.suns[0].direction);
    // The reference takes the disc for a part of the sky.
    reference::Lights lights;
    lights.sky = [&](const glm::dvec3& d) {
        return sky(light, d) + (glm::dot(d, sun) > std::cos(kPi / 6) ? 2 / (kPi * 0.25) : 0.0);
    };
    lights.points.push_back({glm::dvec3(8.5, 8.5, 15), 20});
    double squares = 0;
    int values = 0;
    for (const glm::ivec3& texel : texels_) {
        const std::vector<float> found = lattice->payload(device(), texel);
        ASSERT_EQ(found.size(), 9u);
        const auto expected = reference::irradianceByBounce(field_, isovalueOf(texel), glm::dvec3(texel), lights, 2, 8000, 3);
        for (std::size_t k = 0; k < 3; ++k) {
            // 512 low-discrepancy paths are worth at least as many random ones: sixteen times the variance of 8000.
            const double error = expected.standard_error[k] * std::sqrt(1 + 8000.0 / 512);
            EXPECT_NEAR(found[3 * k], expected.mean[k], 4 * error + 0.003)
                << texel.x << ", " << texel.y << ", " << texel.z << ": " << k;
            squares += std::pow((found[3 * k] - expected.mean[k]) / (error + 1e-3), 2);
            ++values;
            EXPECT_NEAR(found[3 * k], found[3 * k + 1], 1e-5 * found[3 * k]) << "white light";
        }
    }
    EXPECT_LT(std::sqrt(squares / values), 1.3) << "root mean square of errors in standard errors";
}

TEST_F(LatticeLight, TransferAgreesWithPathTracingInDouble) {
    model::Illumination light = settings();
    light.payload = model::TexelPayload::kTransfer;
    const auto lattice = full(volume(image_), light);
    double squares = 0;
    int values = 0;
    for (const glm::ivec3& texel : texels_) {
        const std::vector<float> found = lattice->payload(device(), texel);
        ASSERT_EQ(found.size(), 38u);
        const auto expected = reference::transferByBounce(field_, isovalueOf(texel), glm::dvec3(texel), {5, 3, 2}, 4000, 4);
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double error = expected.standard_error[i] * std::sqrt(1 + 4000.0 / 512);
            EXPECT_NEAR(found[i], expected.mean[i], 4.5 * error + 0.003)
                << texel.x << ", " << texel.y << ", " << texel.z << ": " << i;
            squares += std::pow((found[i] - expected.mean[i]) / (error + 1e-3), 2);
            ++values;
        }
    }
    EXPECT_LT(std::sqrt(squares / values), 1.2);
}

TEST_F(LatticeLight, VicinityIsTheSameByBothPayloads) {
    // No bounces and a constant sky of 1: irradiance over pi is sqrt(4 pi) / pi times the coefficient of band 0.
    model::Illumination light = settings();
    light.bounces = 0;
    light.sky = {glm::vec3(1), glm::vec3(0), {0, 0, 1}};
    const auto data = volume(image_);
    const auto irradiance = full(data, light);
    light.payload = model::TexelPayload::kTransfer;
    light.orders = {1, 1, 1, 1, 1};
    const auto transfer = full(data, light);
    for (const glm::ivec3& texel : texels_) {
        const float vicinity = irradiance->payload(device(), texel).at(0) / static_cast<float>(kPi);
        EXPECT_LE(vicinity, 1.0001F);
        // The same points, so the same paths.
        EXPECT_NEAR(transfer->payload(device(), texel).at(0) * std::sqrt(4 * kPi) / kPi, vicinity, 1e-5);
    }
}

TEST_F(LatticeLight, StandardErrorsAreCalibratedAndErrorsFallAtLeastAsRandomOnes) {
    // Student's t for four replicates: 95 % of errors within 3.18 standard errors. Against texels of sixteen times the samples.
    // Errors of random points fall with the root of the samples; those of low-discrepancy points as fast or faster.
    model::Illumination light = settings();
    const auto data = volume(image_);
    light.samples_max = 16;
    const auto coarsest = full(data, light);
    light.samples_max = 64;
    const auto coarse = full(data, light);
    light.samples_max = 1024;
    const auto fine = full(data, light);
    int within = 0, all = 0;
    double squares_of_16 = 0, squares_of_64 = 0;
    const double luminance_weight[3] = {1, 0.7, 0.49};
    for (int z = 2; z < 16; z += 2) {
        for (int y = 2; y < 16; y += 1) {
            for (int x = 2; x < 16; x += 2) {
                const std::vector<float> a = coarse->payload(device(), {x, y, z}), b = fine->payload(device(), {x, y, z}),
                                         c = coarsest->payload(device(), {x, y, z});
                if (a.empty() || b.empty() || c.empty()) continue;
                double off = 0, off_of_16 = 0, mean = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    off += luminance_weight[k] * (a[3 * k] - b[3 * k]);
                    off_of_16 += luminance_weight[k] * (c[3 * k] - b[3 * k]);
                    mean += luminance_weight[k] * a[3 * k];
                }
                squares_of_16 += off_of_16 * off_of_16;
                squares_of_64 += off * off;
                const double error = coarse->relativeError(device(), {x, y, z}) * mean;
                if (error == 0) continue;
                ++all;
                within += std::abs(off) <= 3.18 * error;
            }
        }
    }
    EXPECT_GT(all, 300);
    // The finer texels have an error of their own, a quarter or less of it.
    EXPECT_GT(within, 0.90 * all);
    EXPECT_LT(within, 0.99 * all);
    EXPECT_LT(std::log(squares_of_64 / squares_of_16) / 2 / std::log(64.0 / 16), -0.5) << "slope of errors against samples";
}

TEST_F(LatticeLight, HalvesAreAsGoodAsFloats) {
    model::Illumination light = settings();
    light.samples_max = 32;
    const auto data = volume(image_);
    const auto wide = full(data, light);
    light.storage = model::TexelStorage::kFloat16;
    const auto narrow = full(data, light);
    for (const glm::ivec3& texel : texels_) {
        const std::vector<float> a = wide->payload(device(), texel), b = narrow->payload(device(), texel);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 5e-4 * a[i] + 1e-6);
    }
    EXPECT_LT(narrow->pool().bytes(), wide->pool().bytes());
}

TEST_F(LatticeLight, ValuesTimesAPowerOfTwoChangeNothing) {
    model::Illumination light = settings();
    light.samples_max = 16;
    model::ScalarImage doubled = image_;
    for (float& value : doubled.values) value *= 8;
    const auto lattice = full(volume(image_), light), other = full(volume(doubled), light);
    for (const glm::ivec3& texel : texels_) EXPECT_EQ(lattice->payload(device(), texel), other->payload(device(), texel));
}

TEST_F(LatticeLight, IsLinearInTheLight) {
    model::Illumination light = settings();
    light.samples_max = 16;
    const auto data = volume(image_);
    const auto one = full(data, light);
    light.sky.radiance *= 3;
    light.sky.gradient *= 3;
    const auto three = full(data, light);
    for (const glm::ivec3& texel : texels_) {
        const std::vector<float> a = one->payload(device(), texel), b = three->payload(device(), texel);
        for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(3 * a[i], b[i], 1e-5 * b[i] + 1e-6);
    }
}

}  // namespace
}  // namespace radiata
