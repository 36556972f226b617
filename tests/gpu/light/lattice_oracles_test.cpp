// Texels where light is known in closed form: closed spheres, cavities, furnaces, lamps, walls and skies. Every texel lies on a
// level set of its own, so whole lattices meet each formula many times: means over their texels are compared within 4.5
// standard errors of the mean, by the spread of the texels, beside a stated bound for what trilinear data round off.
#include <cmath>
#include <numbers>

#include "gpu/light/lattice_fixture.h"
#include "math/sh_evaluate.h"
#include "reference/path_tracer.h"
#include "reference/projected_cap.h"

namespace radiata {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kErrors = 4.5;

/// Mean of numbers of which each has an error of its own.
struct Mean {
    double sum = 0, squares = 0;
    int count = 0;
    void add(double value) {
        sum += value;
        squares += value * value;
        ++count;
    }
    double mean() const { return sum / count; }
    double error() const { return std::sqrt(std::max(squares / count - mean() * mean(), 0.0) / (count - 1)); }
};

class LatticeOracles : public test::LatticeTest {
protected:
    /// Dark, by 16 paths a texel.
    static model::Illumination settings(int bounces, int samples = 16) {
        model::Illumination light;
        light.storage = model::TexelStorage::kFloat32;
        light.bounces = bounces;
        light.relative_error = 1e-6F;
        light.samples_max = samples;
        light.project = false;
        light.sky = {glm::vec3(0), glm::vec3(0), {0, 0, 1}};
        return light;
    }
    /// Calls use(texel, payload) for every texel that has one: all in two downloads, as each one has its price.
    template <typename Use>
    void forTexels(const render::IlluminationLattice& lattice, const Use& use) {
        constexpr int kEdge = static_cast<int>(shader::TEXEL_BRICK_EDGE);
        const glm::ivec3 size = lattice.size(), bricks = (size + (kEdge - 1)) / kEdge;
        const auto count = static_cast<std::size_t>(lattice.settings().payloadCount());
        const std::size_t places = lattice.pool().slotsUsed() * std::size_t{shader::TEXELS_PER_BRICK};
        std::vector<std::uint32_t> states(places);
        std::vector<float> values(places * count);
        gpu::download(device(), lattice.pool().state(), 0, std::as_writable_bytes(std::span(states)));
        gpu::download(device(), lattice.pool().payload(), 0, std::as_writable_bytes(std::span(values)));
        for (int i = 0; i < size.x * size.y * size.z; ++i) {
            const glm::ivec3 texel(i % size.x, i / size.x % size.y, i / (size.x * size.y)), brick = texel / kEdge,
                                                                                            at = texel % kEdge;
            const std::uint32_t slot =
                lattice.pool().slotOf(static_cast<std::uint32_t>(brick.x + bricks.x * (brick.y + bricks.y * brick.z)));
            if (slot == 0) continue;
            const std::size_t place = (slot - 1) * std::size_t{shader::TEXELS_PER_BRICK} +
                                      static_cast<std::size_t>(at.x + kEdge * (at.y + kEdge * at.z));
            if (render::texelSamples(states[place]) == 0) continue;
            const auto first = values.begin() + static_cast<std::ptrdiff_t>(place * count);
            use(texel, std::vector<float>(first, first + static_cast<std::ptrdiff_t>(count)));
        }
    }
};

TEST_F(LatticeOracles, LampsInTheCentreOfAClosedSphereComeBackFromEveryBounce) {
    // E_k = I / r^2 for every k, of a point (red) as of a sphere (green); nothing comes in from without (blue).
    const glm::dvec3 centre(7.5);
    model::Illumination light = settings(3);
    light.lights.push_back({centre, 0, {50, 0, 0}});
    light.lights.push_back({centre, 1.5, {0, 50, 0}});
    light.lights.push_back({centre + 20.0, 2, {0, 0, 500}});
    light.suns.push_back({{1, 0, 0.5}, 10, {0, 0, 3}});
    light.sky.radiance = {0, 0, 1};
    const auto lattice =
        full(volume(image(glm::ivec3(16), [&](const glm::dvec3& p) { return glm::length(p - centre); })), light);
    Mean means[2][4];
    forTexels(*lattice, [&](const glm::ivec3& texel, const std::vector<float>& found) {
        const double r = glm::length(glm::dvec3(texel) - centre);
        if (r < 3.5 || r > 7) return;
        for (std::size_t k = 0; k < 4; ++k) {
            // Trilinear distances are too large by u (1 - u) / 2 of each axis' second derivative, 1 / (6 r) on the mean, which
            // brings the walls that paths meet nearer by as much; and paths start 0.02 nearer.
            const double wall = r - reference::kSurfaceOffset - (k > 0 ? 1 / (6 * r) : 0);
            for (std::size_t c = 0; c < 2; ++c) means[c][k].add(found[3 * k + c] * wall * wall / 50);
            EXPECT_EQ(found[3 * k + 2], 0) << "a leak at bounce " << k << " of texel " << texel.x << ", " << texel.y << ", "
                                           << texel.z;
        }
    });
    for (const auto& colour : means) {
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_GT(colour[k].count, 700);
            EXPECT_NEAR(colour[k].mean(), 1, 0.003 + kErrors * colour[k].error()) << "bounce " << k;
        }
    }
}

TEST_F(LatticeOracles, SphericalLampsShineOverTheHorizonAsFarAsTheyAreOverIt) {
    // On planes that face up: a lamp that is whole over the horizon gives I cos / d^2 (red), one that the horizon cuts the
    // integral over what is left of it (green), one below nothing (blue).
    model::Illumination light = settings(1, 64);
    light.lights.push_back({{6, 5, 14}, 2, {30, 0, 0}});
    light.lights.push_back({{-5, 4, 5}, 3, {0, 30, 0}});
    light.lights.push_back({{5, 5, -3}, 2, {0, 0, 500}});
    const auto lattice = full(volume(image(glm::ivec3(11), [](const glm::dvec3& p) { return 9.3 - p.z; })), light);
    const glm::dvec3 up(0, 0, 1);
    Mean whole, cut;
    forTexels(*lattice, [&](const glm::ivec3& texel, const std::vector<float>& found) {
        const glm::dvec3 from = glm::dvec3(texel) + reference::kSurfaceOffset * up;
        const glm::dvec3 high = glm::dvec3(light.lights[0].position_mm) - from,
                         low = glm::dvec3(light.lights[1].position_mm) - from;
        const double high2 = glm::dot(high, high), low2 = glm::dot(low, low);
        whole.add(found[0] / (30 * high.z / (high2 * std::sqrt(high2))) - 1);
        if (texel.z < 9 && (texel.x + texel.y) % 4 == 0) {
            const double cap = reference::integrateProjectedCap(
                low / std::sqrt(low2), up, std::asin(3 / std::sqrt(low2)), [](const glm::dvec3&) { return 1.0; }, 60);
            const double expected = 30 / (kPi * 9) * cap;
            if (low.z > -2.5) cut.add((found[1] - expected) * low2 / 30);
            if (low.z < -3) {
                EXPECT_EQ(found[1], 0) << "set";
            }
        }
        EXPECT_EQ(found[2], 0) << "through the ground";
        for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(found[3 + c], 0) << "a plane does not see itself";
    });
    EXPECT_EQ(whole.count, 1331);
    EXPECT_NEAR(whole.mean(), 0, 1e-3 + kErrors * whole.error());
    EXPECT_LT(whole.error() * std::sqrt(whole.count), 0.01) << "by 64 low-discrepancy points";
    EXPECT_GT(cut.count, 150);
    EXPECT_NEAR(cut.mean(), 0, 1e-3 + kErrors * cut.error());
    EXPECT_LT(cut.error() * std::sqrt(cut.count), 0.02);
}

TEST_F(LatticeOracles, ThinWallsAreLitOnOneSideOnly) {
    // An oblique wall: at distance t from its middle a level set is 2 t thick. Halves of 0.55 voxels and more have no holes in
    // trilinear data: what they lack in the middle is at most half a voxel.
    const glm::dvec3 n = glm::normalize(glm::dvec3(1, 0.6, 0.35));
    const double middle = glm::dot(n, glm::dvec3(6.4));
    model::Illumination light = settings(2);
    light.lights.push_back({glm::dvec3(6.4) + 12.0 * n, 2, {100, 0, 0}});
    light.lights.push_back({glm::dvec3(6.4) - 12.0 * n, 0, {0, 100, 0}});
    light.suns.push_back({n, 20, {1, 0, 0}});
    const auto lattice =
        full(volume(image(glm::ivec3(13), [&](const glm::dvec3& p) { return -std::abs(glm::dot(n, p) - middle); })), light);
    int thin = 0, plane = 0;
    forTexels(*lattice, [&](const glm::ivec3& texel, const std::vector<float>& found) {
        const double t = glm::dot(n, glm::dvec3(texel)) - middle;
        if (std::abs(t) < 0.55) return;
        thin += std::abs(t) < 0.75;
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(found[3 * k + (t < 0 ? 0 : 1)], 0) << "a leak through " << 2 * std::abs(t) << " voxels at bounce " << k;
        }
        if (t < -3.5) {
            ++plane;
            const glm::dvec3 towards = light.lights[1].position_mm - (glm::dvec3(texel) - reference::kSurfaceOffset * n);
            const double squared = glm::dot(towards, towards);
            const double expected = -100 * glm::dot(n, towards) / (squared * std::sqrt(squared));
            EXPECT_NEAR(found[1], expected, 1e-3 * expected) << "a plane under a point";
        }
    });
    EXPECT_GT(thin, 30);
    EXPECT_GT(plane, 100);
}

TEST_F(LatticeOracles, ClosedShellsLetNothingInAndNothingOut) {
    // Level sets are shells around a sphere of radius 5.2, from 1.1 voxels thick. Red is without, green within.
    const glm::dvec3 centre(7.6, 7.4, 7.5);
    model::Illumination light = settings(4);
    light.sky.radiance = {1, 0, 0};
    light.suns.push_back({{0.2, 1, 0.4}, 8, {5, 0, 0}});
    light.lights.push_back({centre + glm::dvec3(30, 5, 9), 2, {1000, 0, 0}});
    light.lights.push_back({centre + glm::dvec3(0.3, -0.2, 0.4), 0.5, {0, 50, 0}});
    const auto lattice = full(
        volume(image(glm::ivec3(16), [&](const glm::dvec3& p) { return -std::abs(glm::length(p - centre) - 5.2); })), light);
    int within = 0, without = 0;
    forTexels(*lattice, [&](const glm::ivec3& texel, const std::vector<float>& found) {
        const double t = glm::length(glm::dvec3(texel) - centre) - 5.2;
        // Shells that the volume's end cuts open are open.
        if (std::abs(t) < 0.55 || t > 5.2 - 1.5) return;
        ++(t < 0 ? within : without);
        for (std::size_t k = 0; k < 5; ++k) {
            EXPECT_EQ(found[3 * k + (t < 0 ? 0 : 1)], 0) << "a leak at " << t << " and bounce " << k;
        }
        if (t > -3.5 && t < 0) {
            EXPECT_GT(found[1], 0) << "its own light";
        }
    });
    EXPECT_GT(within, 350);
    EXPECT_GT(without, 1000);
}

TEST_F(LatticeOracles, CavitiesWithAnOpeningNearTheirClosedFormWithTheGrid) {
    // Form factors in a sphere are constant, so E_k / pi = s (1 - s)^k at every point of the wall, s the opening's share of the
    // sphere. Trilinear data round the rim off, which opens it: an error of first order in the grid's spacing.
    model::Illumination light = settings(3, 32);
    light.sky.radiance = glm::vec3(1);
    double off[2][4];
    for (int i = 0; i < 2; ++i) {
        const int size = 16 << i;
        const glm::dvec3 centre(0.5 * (size - 1));
        const double radius = 0.3 * size, top = radius * (1 - 2 * 0.2);
        // The finer volume has a texel for eight voxels.
        light.resolution = i == 0 ? model::LatticeResolution::kOne : model::LatticeResolution::kEighth;
        const auto lattice = full(volume(image(glm::ivec3(size),
                                               [&](const glm::dvec3& p) {
                                                   return std::min(centre.z + top - p.z, glm::length(p - centre) - radius);
                                               })),
                                  light);
        Mean means[4];
        forTexels(*lattice, [&](const glm::ivec3& texel, const std::vector<float>& found) {
            const glm::dvec3 p = glm::dvec3(texel << i) - centre;
            // Own level sets are such cavities too: larger by v, and open from v lower.
            const double v = glm::length(p) - radius, share = (1 - (top - v) / (radius + v)) / 2;
            if (std::abs(v) > 0.06 * size || p.z > 0) return;
            for (std::size_t k = 0; k < 4; ++k) means[k].add(found[3 * k] / kPi - share * std::pow(1 - share, k));
        });
        EXPECT_GT(means[0].count, 150);
        for (std::size_t k = 0; k < 4; ++k) {
            off[i][k] = means[k].mean();
            EXPECT_LT(std::abs(off[i][k]), 0.12 / (1 << i) + kErrors * means[k].error()) << "size " << size << ", bounce " << k;
        }
    }
    EXPECT_GT(off[0][0], 0) << "the rim is rounder on the coarse grid";
    EXPECT_LT(off[1][0], 0.65 * off[0][0]);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(2 * off[1][k] - off[0][k], 0, 0.02) << "by Richardson, bounce " << k;
}

TEST_F(LatticeOracles, WhiteFurnacesAreEvenlyLit) {
    // A sky of 1 and white surfaces: all light that leaves comes in somewhere, so the E_k add up to pi. Of five terms they lack
    // what is left of paths after them; in a cap of a sphere that goes on as it began, by the same factor for each bounce.
    model::Illumination light = settings(4, 32);
    light.sky.radiance = glm::vec3(1);
    const glm::dvec3 centre(5.5, 5.5, 8);
    const auto lattice = full(
        volume(image(glm::ivec3(12), [&](const glm::dvec3& p) { return std::min(7 - p.z, glm::length(p - centre) - 4.5); })),
        light);
    Mean sums, bounces[5];
    forTexels(*lattice, [&](const glm::ivec3& texel, const std::vector<float>& found) {
        double sum = 0;
        for (std::size_t k = 0; k < 5; ++k) {
            EXPECT_GE(found[3 * k], 0);
            sum += found[3 * k] / kPi;
        }
        EXPECT_LE(sum, 1 + 1e-5) << "no more than the sky has";
        const glm::dvec3 p = glm::dvec3(texel) - centre;
        if (std::abs(glm::length(p) - 4.5) > 0.7 || texel.z > 5) return;
        sums.add(sum);
        for (std::size_t k = 0; k < 5; ++k) bounces[k].add(found[3 * k] / kPi);
    });
    EXPECT_GT(sums.count, 40);
    EXPECT_LT(bounces[0].mean(), 0.75) << "much of it by bounces";
    const double ratio = bounces[4].mean() / bounces[3].mean(), rest = bounces[4].mean() * ratio / (1 - ratio);
    EXPECT_LT(rest, 0.02);
    EXPECT_NEAR(sums.mean() + rest, 1, 0.002 + kErrors * sums.error());
}

TEST_F(LatticeOracles, FloorsSeeWhatAWallLeavesOfTheSky) {
    // E / pi = 1 - F, F the form factor from a floor's point to a wall of height h that ends at y1 and y2; of an endless one it
    // is (1 - cos(atan(h / d))) / 2. Half a wall to one side: (atan(y / d) - d / g atan(y / g)) / 2 pi, g = |(d, h)|.
    model::Illumination light = settings(0, 64);
    light.sky.radiance = glm::vec3(1);
    const auto half = [](double y, double d, double h) {
        const double g = std::hypot(d, h);
        return (std::atan(y / d) - d / g * std::atan(y / g)) / (2 * kPi);
    };
    EXPECT_NEAR(2 * half(1e9, 3, 4), (1 - std::cos(std::atan(4.0 / 3))) / 2, 1e-8);
    const auto lattice = full(volume(image(glm::ivec3(22, 25, 14),
                                           [](const glm::dvec3& p) { return std::max(3 - p.z, std::min(6 - p.x, 11 - p.z)); })),
                              light);
    Mean off;
    forTexels(*lattice, [&](const glm::ivec3& texel, const std::vector<float>& found) {
        const double v = 3 - texel.z, distance = texel.x - (6 - v);  // own level sets: all of it lower and nearer by v
        if (std::abs(v) > 1 || distance < 4 || texel.y < 5 || texel.y > 19 || texel.x > 19) return;
        off.add(found[0] / kPi - 1 + half(texel.y, distance, 8) + half(24 - texel.y, distance, 8));
    });
    EXPECT_GT(off.count, 300);
    // The wall's upper edge is rounded off by less than half a voxel of eight.
    EXPECT_NEAR(off.mean(), 0, 0.01 + kErrors * off.error());
    EXPECT_LT(off.error() * std::sqrt(off.count), 0.03) << "by 64 low-discrepancy points";
}

TEST_F(LatticeOracles, PlanesUnderAGradientSkyAndBallsInTransferAreCosineLobes) {
    // E / pi = a + 2 b / 3 under a sky of a + b z. Transfer of a convex surface is pi times 1, 2/3, 1/4, 0, -1/24 times
    // Y_lm(n).
    model::Illumination light = settings(0, 64);
    light.sky = {glm::vec3(0.7F, 0.5F, 1), glm::vec3(0.4F, 0.5F, 0), {0, 0, 1}};
    Mean red, green;
    forTexels(*full(volume(image(glm::ivec3(6), [](const glm::dvec3& p) { return 9.3 - p.z; })), light),
              [&](const glm::ivec3&, const std::vector<float>& found) {
                  red.add(found[0] / kPi - 0.7 - 2 * 0.4 / 3);
                  green.add(found[1] / kPi - 0.5 - 2 * 0.5 / 3);
                  EXPECT_NEAR(found[2], kPi, 1e-5);
              });
    EXPECT_NEAR(red.mean(), 0, 1e-5 + kErrors * red.error());
    EXPECT_NEAR(green.mean(), 0, 1e-5 + kErrors * green.error());
    EXPECT_LT(red.error(), 0.002);

    light.payload = model::TexelPayload::kTransfer;
    const glm::dvec3 centre(5.4, 5.5, 5.6);
    const double lobe[5] = {1, 2.0 / 3, 0.25, 0, -1.0 / 24};
    Mean off[25];
    std::vector<double> y(25);
    forTexels(*full(volume(image(glm::ivec3(12), [&](const glm::dvec3& p) { return 5 - glm::length(p - centre); })), light),
              [&](const glm::ivec3& texel, const std::vector<float>& found) {
                  const glm::dvec3 p = glm::dvec3(texel) - centre;
                  if (glm::length(p) < 3 || glm::length(p) > 5) return;
                  evaluateSh(ShLayout{4, true}, glm::normalize(p), y);
                  for (int l = 0; l < 5; ++l) {
                      for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
                          const auto at = static_cast<std::size_t>(i);
                          off[at].add(found[at] - kPi * lobe[l] * y[at]);
                      }
                  }
              });
    for (const Mean& each : off) {
        EXPECT_GT(each.count, 300);
        // Dents of trilinear spheres hide less than a hundredth.
        EXPECT_NEAR(each.mean(), 0, 0.01 + kErrors * each.error());
        EXPECT_LT(each.error(), 0.01);
    }
}

TEST_F(LatticeOracles, LightsAddUpPathByPath) {
    // E(L1 + L2) = E(L1) + E(L2) with the same paths, and turned data under turned light are the same up to the paths.
    const auto bitten = [](const glm::dvec3& p) {
        return std::min(4.6 - glm::length(p - 6.0), glm::length(p - glm::dvec3(6.2, 6, 9.5)) - 3.4);
    };
    const auto data = volume(image(glm::ivec3(13), bitten));
    model::Illumination sky = settings(2), lamps = sky, both = sky;
    sky.sky = both.sky = {glm::vec3(0.8F, 0.4F, 0.3F), glm::vec3(0.5F, 0.1F, 0.2F), {0.2, -0.3, 1}};
    lamps.suns = both.suns = {{{0.3, 0.2, 1}, 20, glm::vec3(2, 1, 0.5)}};
    lamps.lights = both.lights = {{{6, 7, 11}, 1, glm::vec3(20, 30, 5)}};
    const auto first = full(data, sky), second = full(data, lamps), sum = full(data, both);
    both.sky.up = {1, 0.2, -0.3};  // x, y, z become y, z, x
    both.suns[0].direction = {1, 0.3, 0.2};
    both.lights[0].position_mm = {11, 6, 7};
    const auto turned = full(volume(image(glm::ivec3(13), [&](const glm::dvec3& p) { return bitten({p.y, p.z, p.x}); })), both);
    const auto payloads = [&](const render::IlluminationLattice& lattice) {
        std::vector<std::vector<float>> all(13 * 13 * 13);
        forTexels(lattice, [&](const glm::ivec3& t, const std::vector<float>& found) {
            all[static_cast<std::size_t>(t.x + 13 * (t.y + 13 * t.z))] = found;
        });
        return all;
    };
    const auto a = payloads(*first), b = payloads(*second), c = payloads(*turned);
    Mean off;
    forTexels(*sum, [&](const glm::ivec3& t, const std::vector<float>& found) {
        const auto at = static_cast<std::size_t>(t.x + 13 * (t.y + 13 * t.z));
        const std::vector<float>& there = c[static_cast<std::size_t>(t.z + 13 * (t.x + 13 * t.y))];
        ASSERT_EQ(a[at].size(), found.size());
        ASSERT_EQ(b[at].size(), found.size());
        ASSERT_EQ(there.size(), found.size());
        for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], a[at][i] + b[at][i], 1e-5 * found[i] + 1e-6);
        off.add((there[0] + there[3] + there[6]) / std::max(found[0] + found[3] + found[6], 0.1F) - 1);
    });
    EXPECT_GT(off.count, 1500);
    EXPECT_NEAR(off.mean(), 0, kErrors * off.error());
    EXPECT_LT(off.error(), 0.01);
}

}  // namespace
}  // namespace radiata
