// Texels under environment maps, in RGB8, by random paths, and whole lattices that are saved and read back.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <unistd.h>

#include "base/error.h"
#include "build/light_harmonics.h"
#include "gpu/light/lattice_fixture.h"
#include "io/lattice_file.h"
#include "reference/path_tracer.h"

namespace radiata {
namespace {

double bitten(const glm::dvec3& p) {
    return std::min(6.3 - glm::length(p - 8.5), glm::length(p - glm::dvec3(8.5, 8.5, 13)) - 4.6);
}

class LatticeSettings : public test::LatticeTest {
protected:
    const glm::ivec3 size_{18};
    model::ScalarImage image_ = image(size_, bitten);
    reference::ScalarField field_{size_, std::vector<double>(image_.values.begin(), image_.values.end())};
    const std::vector<glm::ivec3> texels_{{8, 8, 8}, {6, 9, 9}, {10, 7, 9}, {8, 5, 11}, {3, 8, 8}, {8, 12, 5}, {12, 10, 10}};

    static model::Illumination settings() {
        model::Illumination light;
        light.storage = model::TexelStorage::kFloat32;
        light.bounces = 2;
        light.relative_error = 1e-6F;
        light.samples_max = 512;
        light.project = false;
        return light;
    }
    double isovalueOf(const glm::ivec3& texel) const {
        const double range = *std::ranges::max_element(image_.values) - *std::ranges::min_element(image_.values);
        return field_.value(glm::dvec3(texel)) + 1e-5 * range;
    }
    std::unique_ptr<render::IlluminationLattice> lit(const model::Illumination& light,
                                                     const std::shared_ptr<const model::EnvironmentMap>& map = nullptr) {
        auto lattice = std::make_unique<render::IlluminationLattice>(device(), volume(image_), light, false);
        lattice->update(run(), light, map, glm::vec3(0.7F), 0);
        lattice->requestAll(run());
        lattice->refine(run(), {});
        return lattice;
    }
};

/// Grey, darker below, with a sun of two pixels that has half of all light.
std::shared_ptr<const model::EnvironmentMap> sunnyMap() {
    model::EnvironmentMap map{32, 16, {}, "made", {}};
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 32; ++x) map.pixels.emplace_back(0.2F + 0.05F * static_cast<float>(15 - y));
    }
    map.pixels[3 * 32 + 17] = map.pixels[3 * 32 + 18] = glm::vec3(250);
    return std::make_shared<const model::EnvironmentMap>(std::move(map));
}

TEST_F(LatticeSettings, EnvironmentMapsAgreeWithPathTracingInDouble) {
    const auto map = sunnyMap();
    model::Illumination light = settings();
    light.environment = model::EnvironmentLight{"made", 0.5F};
    light.rotation = {1, 0.2, -0.1, 0.4};
    const auto lattice = lit(light, map);
    // The reference takes the map for a function and meets its sun by chance.
    const glm::dmat3 back = glm::transpose(lightRotation(light));
    const reference::Lights lights{[&](const glm::dvec3& d) {
                                       const glm::dvec3 m = back * d;
                                       const double u = std::atan2(m.x, m.y) / (2 * std::numbers::pi) + 0.5;
                                       const double v = std::acos(std::clamp(m.z, -1.0, 1.0)) / std::numbers::pi;
                                       const int x = std::min(static_cast<int>(u * 32), 31);
                                       const int y = std::min(static_cast<int>(v * 16), 15);
                                       return 0.5 * static_cast<double>(map->pixels[static_cast<std::size_t>(y * 32 + x)].x);
                                   },
                                   {}};
    double squares = 0;
    int values = 0;
    for (const glm::ivec3& texel : texels_) {
        const std::vector<float> found = lattice->payload(device(), texel);
        ASSERT_EQ(found.size(), 9u);
        const auto expected = reference::irradianceByBounce(field_, isovalueOf(texel), glm::dvec3(texel), lights, 2, 12000, 5);
        for (std::size_t k = 0; k < 3; ++k) {
            // The device looks for the sun, so that its error is at most that of as many random paths as the reference has.
            const double error = expected.standard_error[k] * std::sqrt(2.0);
            EXPECT_NEAR(found[3 * k], expected.mean[k], 4 * error + 0.004)
                << texel.x << ", " << texel.y << ", " << texel.z << ": " << k;
            squares += std::pow((found[3 * k] - expected.mean[k]) / (error + 1e-3), 2);
            ++values;
        }
    }
    EXPECT_LT(std::sqrt(squares / values), 1.3) << "root mean square of errors in standard errors";
}

TEST_F(LatticeSettings, RgbOfEightBitsIsNearToFloats) {
    model::Illumination light = settings();
    light.samples_max = 32;
    light.sky = {glm::vec3(0.9F, 0.6F, 0.2F), glm::vec3(0.4F, 0.1F, 0.1F), {0, 0, 1}};
    const auto wide = lit(light);
    light.storage = model::TexelStorage::kRgb8;
    const auto narrow = lit(light);
    EXPECT_EQ(narrow->info().payload_bytes, 4 * narrow->pool().slotsUsed() * shader::TEXELS_PER_BRICK);
    EXPECT_EQ(wide->info().payload_bytes, 9 * narrow->info().payload_bytes);
    // Roots of at most 1 in steps of a 255th: radiance r of at most s is off by at most sqrt(r s) / 255.
    const double scale = 1.5 * (0.9 + 0.4);
    for (const glm::ivec3& texel : texels_) {
        const std::vector<float> a = wide->payload(device(), texel), b = narrow->payload(device(), texel);
        ASSERT_EQ(b.size(), 3u);
        for (std::size_t c = 0; c < 3; ++c) {
            const double radiance = (a[c] + 0.7 * a[3 + c] + 0.49 * a[6 + c]) / std::numbers::pi;
            EXPECT_NEAR(b[c] / std::numbers::pi, radiance, std::sqrt(radiance * scale) / 255 + 1e-5);
        }
    }
}

TEST_F(LatticeSettings, RandomPathsMeanTheSameAndNeedMore) {
    model::Illumination light = settings();
    light.samples_max = 256;
    const auto truth = lit(light);
    light.samples_max = 64;
    const auto even = lit(light);
    light.sampling = model::TexelSampling::kRandom;
    const auto random = lit(light);
    double even_squares = 0, random_squares = 0, bias = 0;
    int texels = 0;
    for (int z = 3; z < 15; z += 2) {
        for (int y = 3; y < 15; ++y) {
            for (int x = 3; x < 15; x += 2) {
                const auto exact = truth->payload(device(), {x, y, z});
                if (exact.empty() || exact[0] < 0.1F) continue;
                ++texels;
                even_squares += std::pow(even->payload(device(), {x, y, z}).at(0) / exact[0] - 1, 2);
                const double off = random->payload(device(), {x, y, z}).at(0) / exact[0] - 1;
                random_squares += off * off;
                bias += off;
            }
        }
    }
    EXPECT_GT(texels, 300);
    // Texels see 0.4 to 1 of the sky, so the relative error of 64 random paths is some 8 %; of the mean of hundreds a
    // twentieth.
    EXPECT_NEAR(bias / texels, 0, 0.02);
    EXPECT_LT(2 * even_squares, random_squares) << "as random paths of less than half as many";
}

TEST_F(LatticeSettings, WholeLatticesComeBackAsTheyWereSaved) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("radiata-whole-" + std::to_string(::getpid()) + ".lattice");
    for (const auto payload : {model::TexelPayload::kIrradiance, model::TexelPayload::kTransfer}) {
        model::Illumination light = settings();
        light.payload = payload;
        light.storage = model::TexelStorage::kFloat16;
        light.full = true;
        light.samples_max = 16;
        render::IlluminationLattice lattice(device(), volume(image_), light, false);
        EXPECT_TRUE(lattice.update(run(), light, nullptr, glm::vec3(0.7F), 0)) << "no texel has light";
        EXPECT_FALSE(lattice.lightAll(run(), std::chrono::steady_clock::now())) << "no time";
        EXPECT_LT(lattice.info().texels_done, lattice.info().texels);
        EXPECT_THROW(lattice.save(file), Error) << "not whole yet";
        EXPECT_TRUE(lattice.lightAll(run(), {}));
        EXPECT_EQ(lattice.info().texels_done, 18u * 18 * 18);
        EXPECT_GT(lattice.info().samples, 0u);
        lattice.save(file);

        render::IlluminationLattice again(device(), volume(image_), light, false);
        again.update(run(), light, nullptr, glm::vec3(0.7F), 0);
        again.restore(run(), io::readLattice(file, again.header()));
        EXPECT_TRUE(again.whole());
        EXPECT_EQ(again.info().texels_read, 18u * 18 * 18);
        EXPECT_EQ(again.info().mean_error, lattice.info().mean_error);
        EXPECT_EQ(again.info().p95_error, lattice.info().p95_error);
        for (const glm::ivec3& texel : texels_) {
            EXPECT_EQ(again.payload(device(), texel), lattice.payload(device(), texel));
            EXPECT_EQ(again.relativeError(device(), texel), lattice.relativeError(device(), texel));
        }
        // Another light needs other texels with irradiance, and none with transfer.
        model::Illumination other = light;
        other.sky.radiance = glm::vec3(0.5F);
        render::IlluminationLattice dark(device(), volume(image_), other, false);
        dark.update(run(), other, nullptr, glm::vec3(0.7F), 0);
        EXPECT_EQ(dark.key() == lattice.key(), payload == model::TexelPayload::kTransfer);
        if (payload == model::TexelPayload::kIrradiance) {
            EXPECT_THROW(io::readLattice(file, dark.header()), Error);
            EXPECT_THROW(dark.restore(run(), io::readLattice(file, lattice.header())), Error);
            EXPECT_FALSE(dark.whole());
            EXPECT_TRUE(dark.payload(device(), texels_[0]).empty());
        }
    }
    model::Illumination small = settings();
    small.full = true;
    small.budget_mib = 0.1F;
    render::IlluminationLattice lattice(device(), volume(image_), small, false);
    lattice.update(run(), small, nullptr, glm::vec3(0.7F), 0);
    EXPECT_THROW(lattice.lightAll(run(), {}), Error) << "more than the budget";
    std::filesystem::remove(file);
}

}  // namespace
}  // namespace radiata
