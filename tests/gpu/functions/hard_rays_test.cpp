// The march where it is hard. Unless a test says otherwise: hit or miss as the reference says, of the same sign, for all rays
// whose first hit is conditioned (see compare), and t within the bound stated; and no march gives up.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "gpu/functions/march_runner.h"

namespace radiata {
namespace {

using namespace test;

const std::vector<ShLayout> kLayouts{{4, false}, {8, false}, {16, false}, {4, true}, {8, true}, {16, true}};

glm::vec3 unitVector(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
}

/// The six directions of the axes.
glm::vec3 axisDirection(std::size_t i) {
    glm::vec3 direction(0);
    direction[int(i % 3)] = i % 6 < 3 ? 1.0F : -1.0F;
    return direction;
}

class HardRays : public MarchTest {
protected:
    /// Three random glyphs of each layout, with the rays that `make` gives for them.
    template <typename MakeRays>
    void compareLayouts(const char* name, double bound, int least, MakeRays make) {
        std::mt19937 random(24);
        for (const ShLayout layout : kLayouts) {
            const BoundsEvaluator evaluator(layout);
            Comparison sum;
            for (int i = 0; i < 3; ++i) {
                const std::vector<float> glyph = randomGlyph(random, layout);
                const std::vector<RayInput> rays = make(random, reference::ShFunction(layout, glyph));
                add(sum, compare(glyph, layout, rays, march(layout, glyph, certifiedRadius(evaluator, glyph), rays), bound));
            }
            print(name, layout, sum);
            EXPECT_EQ(sum.wrong, 0) << name << " " << nameOf(layout);
            EXPECT_GE(sum.rays, least) << name << " " << nameOf(layout);
        }
    }

    static void add(Comparison& sum, const Comparison& part) {
        sum = {sum.rays + part.rays, sum.wrong + part.wrong, std::max(sum.worst, part.worst)};
    }
    static void print(const char* name, ShLayout layout, const Comparison& sum) {
        std::printf("%s, %s: %d rays, %d wrong, worst error %.2g\n", name, nameOf(layout).c_str(), sum.rays, sum.wrong,
                    sum.worst);
    }
};

TEST_F(HardRays, WithinATenThousandthOfTheCentre) {
    compareLayouts("at the centre", 3e-4, 500,
                   [](std::mt19937& random, const reference::ShFunction&) { return randomRays(random, 200, 0, 1e-4F); });
}

TEST_F(HardRays, ThroughTheCentre) {
    // Along the axes the distance is 0 exactly, elsewhere it is what rounding leaves. With positive lobes only, a first hit
    // counts as conditioned only if the near lobe is positive; else moving the ray finds other lobes at the centre.
    compareLayouts("through the centre", 3e-4, 200, [](std::mt19937& random, const reference::ShFunction&) {
        std::vector<RayInput> rays = randomRays(random, 200, 0, 0);
        for (std::size_t i = 0; i < 60; ++i) rays[i].origin = -3.0F * (rays[i].direction = axisDirection(i));
        return rays;
    });
}

TEST_F(HardRays, ParallelToAxesAndInTheirPlanes) {
    compareLayouts("parallel to axes", 2e-5, 500, [](std::mt19937& random, const reference::ShFunction&) {
        std::uniform_real_distribution<float> place(-0.7F, 0.7F);
        std::vector<RayInput> rays = randomRays(random, 200, 0, 0);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            glm::vec3 aside(place(random), place(random), place(random));
            aside[int(i % 3)] = 0;
            if (i % 2 == 0) aside[int((i + 1) % 3)] = 0;
            rays[i].direction = axisDirection(i);
            rays[i].origin = aside - 3.0F * rays[i].direction;
        }
        return rays;
    });
}

TEST_F(HardRays, BesideTangentsOfLobes) {
    // 1e-4 to 1e-2 outside or inside of where they touch; at 1e-4 a first hit moves by 7e-2 per unit of the ray's rounding.
    compareLayouts("beside tangents", 1e-4, 300, [](std::mt19937& random, const reference::ShFunction& f) {
        std::uniform_real_distribution<float> unit(0, 1);
        std::vector<RayInput> rays = randomRays(random, 200, 0, 0);
        for (RayInput& ray : rays) {
            const glm::dvec3 p = unitVector(random);
            const glm::dvec3 normal = reference::glyphNormal(f, p);
            const glm::dvec3 tangent = glm::normalize(glm::cross(normal, glm::dvec3(unitVector(random))));
            const double aside = (unit(random) < 0.5F ? -1.0 : 1.0) * std::pow(10.0, -4 + 2 * double(unit(random)));
            ray.direction = tangent;
            ray.origin = std::abs(f(p)) * p + aside * normal - 3.0 * tangent;
        }
        return rays;
    });
}

TEST_F(HardRays, TangentsThemselvesHitTheSurfaceIfTheyHit) {
    // Whether a tangent hits is for rounding to say; what is hit must lie on the surface, within 2e-5 (to first order).
    std::mt19937 random(25);
    for (const ShLayout layout : kLayouts) {
        const BoundsEvaluator evaluator(layout);
        const std::vector<float> glyph = randomGlyph(random, layout);
        const reference::ShFunction f(layout, glyph);
        std::vector<RayInput> rays = randomRays(random, 500, 0, 0);
        for (RayInput& ray : rays) {
            const glm::dvec3 p = unitVector(random);
            const glm::dvec3 tangent = glm::normalize(glm::cross(reference::glyphNormal(f, p), glm::dvec3(unitVector(random))));
            ray.direction = tangent;
            ray.origin = std::abs(f(p)) * p - 3.0 * tangent;
        }
        const auto outputs = march(layout, glyph, certifiedRadius(evaluator, glyph), rays);
        int hits = 0;
        double worst = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (outputs[i].amplitude == 0) continue;
            ++hits;
            const glm::dvec3 point = glm::dvec3(rays[i].origin) + double(outputs[i].t) * glm::dvec3(rays[i].direction);
            const double length = glm::length(point);
            const double steepness = std::hypot(1.0, glm::length(f.gradient(point)) / length);
            worst = std::max(worst, std::abs(length - std::abs(f(point))) / steepness);
        }
        std::printf("tangents, %s: %d of %zu hit, off the surface by %.2g at most\n", nameOf(layout).c_str(), hits, rays.size(),
                    worst);
        EXPECT_GT(hits, 100) << nameOf(layout);
        EXPECT_LT(worst, 2e-5) << nameOf(layout);
    }
}

TEST_F(HardRays, FromInsideTheGlyph) {
    // Rays begin anywhere within 0.6 of the centre, but not within 1e-4 of the surface. Those from the very centre begin 2e-3
    // after it: all lobes meet there.
    compareLayouts("from inside", 1e-4, 300, [](std::mt19937& random, const reference::ShFunction& f) {
        std::uniform_real_distribution<float> unit(0, 1);
        std::vector<RayInput> rays;
        while (rays.size() < 200) {
            const bool centre = rays.size() < 40;
            const glm::vec3 direction = rays.size() < 12 ? axisDirection(rays.size()) : unitVector(random);
            const glm::vec3 origin = centre ? glm::vec3(0) : 0.6F * unit(random) * unitVector(random);
            const glm::dvec3 start(centre ? 2e-3F * direction : origin);
            const bool on_surface = std::abs(glm::length(start) - std::abs(f(start))) < 1e-4;
            rays.push_back(
                {on_surface ? -3.0F * direction : origin, centre ? 2e-3F : 0.0F, direction, std::uint32_t(random() % 2)});
        }
        return rays;
    });
}

TEST_F(HardRays, FromTheCentreItself) {
    // With both lobes a ray from the very centre hits the end of its lobe, or the centre, where other lobes begin.
    std::mt19937 random(30);
    for (const ShLayout layout : kLayouts) {
        const BoundsEvaluator evaluator(layout);
        const std::vector<float> glyph = randomGlyph(random, layout);
        const reference::ShFunction f(layout, glyph);
        std::vector<RayInput> rays = randomRays(random, 300, 0, 0);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (i < 60) rays[i].direction = axisDirection(i);
            rays[i].origin = glm::vec3(0);
            rays[i].both_lobes = 1;
        }
        const auto outputs = march(layout, glyph, certifiedRadius(evaluator, glyph), rays);
        int ends = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const double end = std::abs(f(rays[i].direction));
            const bool at_end = std::abs(double(outputs[i].t) - end) < 2e-5;
            ends += at_end;
            EXPECT_TRUE(outputs[i].amplitude != 0 && (at_end || std::abs(outputs[i].t) < 1e-6F))
                << nameOf(layout) << " ray " << i << " t " << outputs[i].t << " amplitude " << outputs[i].amplitude << " end "
                << end;
        }
        EXPECT_GT(ends, 0) << nameOf(layout);
    }
}

TEST_F(HardRays, FromBehindALobeThroughTheCentre) {
    // The line passes through the centre, but the ray begins outside, beyond the lobe's end, and looks away: it must miss.
    std::mt19937 random(29);
    for (const ShLayout layout : kLayouts) {
        const BoundsEvaluator evaluator(layout);
        const std::vector<float> glyph = randomGlyph(random, layout);
        const reference::ShFunction f(layout, glyph);
        std::vector<RayInput> rays = randomRays(random, 200, 0, 0);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            RayInput& ray = rays[i];
            if (i < 60) ray.direction = axisDirection(i);
            ray.origin = (float(std::abs(f(ray.direction))) + 0.02F) * ray.direction;
        }
        for (const RayOutput& output : march(layout, glyph, certifiedRadius(evaluator, glyph), rays)) {
            EXPECT_EQ(output.amplitude, 0) << nameOf(layout);
        }
    }
}

TEST_F(HardRays, NothingIsHitOfAGlyphOfZeros) {
    std::mt19937 random(26);
    for (const ShLayout layout : kLayouts) {
        const std::vector<float> nothing(layout.count(), 0.0F);
        std::vector<RayInput> rays = randomRays(random, 100, 0, 1);
        for (std::size_t i = 0; i < 6; ++i) rays[i].origin = -3.0F * (rays[i].direction = axisDirection(i));
        rays[6].origin = rays[7].origin = glm::vec3(0);
        for (const float radius : {0.0F, 1.0F}) {
            for (const RayOutput& output : march(layout, nothing, radius, rays)) EXPECT_EQ(output.amplitude, 0);
        }
    }
}

TEST_F(HardRays, EveryBasisFunctionAlone) {
    // Positive and negative; t within 3e-4, as many of these rays pass near the centre, where all lobes meet. The centre
    // itself, hit within 1e-6, counts as a miss. Rays exactly through the centre and along a node, from which the function
    // rises in a high power only, may give up; they miss.
    std::mt19937 random(27);
    for (const ShLayout layout : {ShLayout{4, false}, ShLayout{8, false}, ShLayout{4, true}, ShLayout{8, true}}) {
        const BoundsEvaluator evaluator(layout);
        Comparison sum;
        for (std::size_t i = 0; i < layout.count(); ++i) {
            std::vector<float> glyph(layout.count(), 0.0F);
            glyph[i] = i % 2 == 0 ? 1.0F : -1.0F;
            std::vector<RayInput> rays = randomRays(random, 30, 0, 0.6F);
            for (std::size_t j = 0; j < 6; ++j) rays[j].origin = -3.0F * (rays[j].direction = axisDirection(j));
            auto outputs = march(layout, glyph, certifiedRadius(evaluator, glyph), rays, true);
            for (std::size_t j = 0; j < rays.size(); ++j) {
                if (std::abs(outputs[j].amplitude) < 1e-6F) outputs[j].amplitude = 0;
                EXPECT_TRUE(outputs[j].count == 0 || (j < 6 && outputs[j].amplitude == 0))
                    << nameOf(layout) << ", coefficient " << i;
            }
            const Comparison part = compare(glyph, layout, rays, outputs, 3e-4);
            EXPECT_EQ(part.wrong, 0) << nameOf(layout) << ", coefficient " << i;
            add(sum, part);
        }
        print("one basis function", layout, sum);
        EXPECT_GT(sum.rays, int(layout.count()) * 20);
    }
}

TEST_F(HardRays, HighestBandsAlone) {
    // Nothing but band 16, or 15 and 16: as many lobes as there can be.
    std::mt19937 random(28);
    std::normal_distribution<float> normal;
    for (const ShLayout layout : {ShLayout{16, false}, ShLayout{16, true}}) {
        const BoundsEvaluator evaluator(layout);
        Comparison sum;
        for (int i = 0; i < 3; ++i) {
            std::vector<float> glyph(layout.count(), 0.0F);
            for (int l = layout.full ? 15 : 16; l <= 16; ++l) {
                for (int m = -l; m <= l; ++m) glyph[layout.index(l, m)] = 0.2F * normal(random);
            }
            const std::vector<RayInput> rays = randomRays(random, 300, 0, 0.8F);
            add(sum, compare(glyph, layout, rays, march(layout, glyph, certifiedRadius(evaluator, glyph), rays), 1e-4));
        }
        print("highest bands", layout, sum);
        EXPECT_EQ(sum.wrong, 0) << nameOf(layout);
        EXPECT_GT(sum.rays, 700);
    }
}

}  // namespace
}  // namespace radiata
