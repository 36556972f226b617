// The march in float32 against the double reference, in numbers: bands 2 to 16; random, fODF-like and sharpened glyphs; rays
// over the whole glyph and within 2 % and 0.02 % of the centre. No miss, no false hit, the same lobe, depth within 2e-5 radii.
// Left out are only rays whose first hit comes, goes, changes its lobe or moves by over 1e-3 radii if their distance from the
// centre changes by 1e-5 radii. With RADIATA_FULL set over a million rays are compared; else a share of that.
#include <cmath>
#include <cstdlib>
#include <mutex>

#include "base/parallel.h"
#include "gpu/functions/march_runner.h"

namespace radiata {
namespace {

using namespace test;

constexpr double kDepth = 2e-5;
constexpr double kConditioned = 1e-3;

int raysPerCell() {
    const char* full = std::getenv("RADIATA_FULL");
    return full != nullptr && *full != '\0' ? 5000 : 60;  // times 3 glyphs, 9 cells and 8 band limits
}

/// Uniform coefficients, alike in all bands.
std::vector<float> uniformGlyph(std::mt19937& random, ShLayout layout) {
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<float> glyph(layout.count());
    for (float& c : glyph) c = unit(random);
    return glyph;
}

/// One to three fibre lobes about random directions. \param damping  of the bands, \param isotropic  share of band 0 that stays
std::vector<float> lobedGlyph(std::mt19937& random, ShLayout layout, double damping, double isotropic) {
    std::normal_distribution<double> normal;
    std::vector<double> sum(layout.count(), 0.0);
    const int lobes = 1 + int(random() % 3);
    for (int lobe = 0; lobe < lobes; ++lobe) {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        // The reference evaluates one basis function at a time; slow, and by other code than the shader's.
        for (int l = 0; l <= layout.lmax; l += 2) {
            for (int m = -l; m <= l; ++m) {
                std::vector<double> one(layout.count(), 0.0);
                one[layout.index(l, m)] = 1;
                sum[layout.index(l, m)] +=
                    reference::ShFunction(layout, one)(axis) * std::exp(-damping * l * (l + 1)) / (1 + lobe);
            }
        }
    }
    sum[0] *= isotropic;
    return {sum.begin(), sum.end()};
}

/// Begin beside the centre, as the rays of a picture that looks there do, and look back a long way.
std::vector<RayInput> raysWithin(std::mt19937& random, int count, float distance) {
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<RayInput> rays(static_cast<std::size_t>(count));
    for (RayInput& ray : rays) {
        ray.direction = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
        const glm::vec3 side = glm::normalize(glm::cross(ray.direction, glm::vec3(normal(random), normal(random), 1)));
        ray.origin = distance * std::sqrt(unit(random)) * side;
        ray.t_min = -100;
        ray.both_lobes = unit(random) < 0.5F;
    }
    return rays;
}

class Accuracy : public MarchTest {
protected:
    struct Tally {
        int rays = 0, left_out = 0, missed = 0, false_hits = 0, wrong = 0;
        double worst = 0;
    };

    void compare(ShLayout layout, const std::vector<float>& glyph, double radius, const std::vector<RayInput>& rays,
                 Tally& sum) {
        const auto outputs = march(layout, glyph, float(radius), rays);
        const reference::ShFunction f(layout, glyph);
        std::mutex mutex;
        parallelFor(rays.size(), 16, [&](std::size_t begin, std::size_t end) {
            Tally own;
            for (std::size_t i = begin; i < end; ++i) {
                const reference::GlyphHits expected = truth(f, rays[i]);
                if (!(expected.first_shift < kConditioned)) {
                    ++own.left_out;
                    continue;
                }
                ++own.rays;
                const bool hit = outputs[i].amplitude != 0;
                own.missed += !hit && !expected.hits.empty();
                own.false_hits += hit && expected.hits.empty();
                if (!hit || expected.hits.empty()) continue;
                const double error = std::abs(double(outputs[i].t) - expected.hits[0].t) / radius;
                own.worst = std::max(own.worst, error);
                own.wrong += !(error < kDepth) || (outputs[i].amplitude > 0) != (expected.hits[0].amplitude > 0);
            }
            const std::lock_guard lock(mutex);
            sum.rays += own.rays;
            sum.left_out += own.left_out;
            sum.missed += own.missed;
            sum.false_hits += own.false_hits;
            sum.wrong += own.wrong;
            sum.worst = std::max(sum.worst, own.worst);
        });
    }

    void expectExact(int k) {
        const ShLayout layout{k, false};
        const BoundsEvaluator evaluator(layout);
        const char* kinds[] = {"random", "fODF-like", "sharpened"};
        for (std::size_t kind = 0; kind < 3; ++kind) {
            for (const float distance : {1.0F, 0.02F, 2e-4F}) {
                std::mt19937 random(std::uint32_t(100 * k) + std::uint32_t(kind));
                Tally sum;
                for (int i = 0; i < 3; ++i) {
                    const std::vector<float> glyph = kind == 0   ? uniformGlyph(random, layout)
                                                     : kind == 1 ? lobedGlyph(random, layout, 0.012, 1)
                                                                 : lobedGlyph(random, layout, 0.002, 0.3);
                    const float radius = certifiedRadius(evaluator, glyph);
                    compare(layout, glyph, radius, raysWithin(random, raysPerCell(), distance * radius), sum);
                }
                std::printf(
                    "k %2d, %-9s within %6g radii: %d rays, %d left out, %d missed, %d false, %d wrong, worst %.2g radii\n", k,
                    kinds[kind], double(distance), sum.rays, sum.left_out, sum.missed, sum.false_hits, sum.wrong, sum.worst);
                EXPECT_EQ(sum.missed, 0);
                EXPECT_EQ(sum.false_hits, 0);
                EXPECT_EQ(sum.wrong, 0);

                EXPECT_LT(sum.left_out, 0.05 * (sum.rays + sum.left_out));
            }
        }
    }
};

TEST_F(Accuracy, Band2) { expectExact(2); }
TEST_F(Accuracy, Band4) { expectExact(4); }
TEST_F(Accuracy, Band6) { expectExact(6); }
TEST_F(Accuracy, Band8) { expectExact(8); }
TEST_F(Accuracy, Band10) { expectExact(10); }
TEST_F(Accuracy, Band12) { expectExact(12); }
TEST_F(Accuracy, Band14) { expectExact(14); }
TEST_F(Accuracy, Band16) { expectExact(16); }

}  // namespace
}  // namespace radiata
