// All crossings of a ray with a glyph, by the march on the device, against the exhaustive search. Held for every ray: crossings
// alternate between entries and exits, beginning with what the start of the ray demands; no walk gives up. Held against the
// reference: the same crossings in the same order, each within 2e-5 radii of its surface (measured along the normal), except
// for pairs closer together than kPairRadii, which may be missing or surplus; and the length within the glyph to 5e-5 radii.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "build/phantom.h"
#include "gpu/functions/march_runner.h"
#include "math/sh_convention.h"
#include "shaders/shared/glyph_rays.glsl"
#include "support/npz.h"

namespace radiata {
namespace {

using namespace test;

constexpr double kSurfaceRadii = 2e-5;
constexpr double kPairRadii = 2e-4;
/// A line that grazes may have such pairs as wide as the chord that float32 cannot see: 2 sqrt(2 radius slack).
constexpr double kGrazingPairRadii = 3e-3;

const std::vector<ShLayout> kLayouts{{4, false}, {8, false}, {16, false}, {4, true}, {16, true}};

struct Crossing {
    double t, value;
};

struct Crossings {
    bool begins_inside = false, gave_up = false;
    int steps = 0;
    std::vector<Crossing> at;
};

/// Sum of the ray's parts inside; a ray that begins inside does so at t_min.
double lengthInside(bool begins_inside, double t_min, const std::vector<double>& t) {
    double length = 0, entry = t_min;
    bool inside = begins_inside;
    for (const double now : t) {
        if (inside) length += now - entry;
        entry = now;
        inside = !inside;
    }
    return length;
}

class AllHits : public FunctionTest {
protected:
    std::vector<Crossings> walk(ShLayout layout, const std::vector<float>& glyph, const std::vector<RayInput>& rays) {
        std::vector<float> shared = glyph;
        shared.push_back(certifiedRadius(evaluator(layout), glyph));
        const std::size_t most = (layout.full ? 2 : 1) * (2 * std::size_t(layout.lmax) + 2);
        const std::size_t width = shader::GLYPH_RAY_HEADER + shader::GLYPH_RAY_WORDS * most;
        const std::vector<float> values = runFunctionToFloats("glyph_all_hits_" + nameOf(layout), {}, rays, width, shared);
        std::vector<Crossings> result(rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const float* row = values.data() + i * width;
            const float* hits = row + shader::GLYPH_RAY_HEADER;
            result[i].begins_inside = row[0] > 0 && hits[2] == 0;
            result[i].gave_up = row[1] != 0;
            result[i].steps = int(row[2]);
            EXPECT_LE(std::size_t(row[0]), most);
            for (std::size_t hit = 0; hit < std::size_t(row[0]); ++hit, hits += shader::GLYPH_RAY_WORDS) {
                result[i].at.push_back({double(hits[0]), double(hits[1])});
                // Entries and exits alternate.
                EXPECT_EQ(hits[2] != 0, (hit % 2 == 0) != result[i].begins_inside);
            }
        }
        return result;
    }

    struct Tally {
        int rays = 0, wrong = 0, other_count = 0, pairs = 0, steps = 0;
        std::size_t most = 0;
        double apart = 0, length = 0, widest_pair = 0;
    };

    void compare(ShLayout layout, const std::vector<float>& glyph, const std::vector<RayInput>& rays, Tally& tally) {
        const reference::ShFunction f(layout, glyph);
        const double radius = certifiedRadius(evaluator(layout), glyph);
        const std::vector<Crossings> found = walk(layout, glyph, rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const reference::GlyphHits expected = truth(f, rays[i]);
            const bool even = found[i].at.size() % 2 == 0;
            const bool right =
                match(expected, found[i].at, rays[i], radius, tally) && !found[i].gave_up && even == !found[i].begins_inside;
            std::vector<double> expected_t, found_t;
            for (const reference::GlyphHit& hit : expected.hits) expected_t.push_back(hit.t);
            for (const Crossing& hit : found[i].at) found_t.push_back(hit.t);
            const double t_min = rays[i].t_min;
            const double length = lengthInside(expected_t.size() % 2 == 1, t_min, expected_t);
            const double off = std::abs(lengthInside(!even, t_min, found_t) - length) / radius;
            // A tangent's chord comes and goes with 1e-5 radii of its place; only clear chords have a length to compare.
            if (!expected.grazing) tally.length = std::max(tally.length, off);
            ++tally.rays;
            tally.steps += found[i].steps;
            tally.most = std::max(tally.most, found[i].at.size());
            tally.other_count += found_t.size() != expected_t.size();
            if (!right && ++tally.wrong <= 3) printCrossings(rays[i], expected.hits, found[i].at);
        }
    }

    static void print(const char* name, ShLayout layout, const Tally& tally) {
        std::printf(
            "%s, %s: %d rays, up to %zu hits, %.1f steps each; %d wrong, %d of another count: %d close pairs "
            "up to %.1e radii; off by %.1e radii, length by %.1e\n",
            name, nameOf(layout).c_str(), tally.rays, tally.most, double(tally.steps) / tally.rays, tally.wrong,
            tally.other_count, tally.pairs, tally.widest_pair, tally.apart, tally.length);
    }

    const BoundsEvaluator& evaluator(ShLayout layout) {
        std::optional<BoundsEvaluator>& made = evaluators_[nameOf(layout)];
        if (!made) made.emplace(layout);
        return *made;
    }

private:
    /// Both lists in order; a close pair of one lobe that the other list does not have is passed over.
    static bool match(const reference::GlyphHits& truth, const std::vector<Crossing>& found, const RayInput& ray, double radius,
                      Tally& tally) {
        const std::vector<reference::GlyphHit>& expected = truth.hits;
        const double widest = (truth.grazing ? kGrazingPairRadii : kPairRadii) * radius;
        const auto closePair = [widest](double a, double b) { return std::abs(b - a) < widest; };
        std::size_t i = 0, j = 0;
        while (i < expected.size() || j < found.size()) {
            if (i < expected.size() && j < found.size() && (expected[i].amplitude > 0) == (found[j].value > 0)) {
                const double facing = std::abs(glm::dot(expected[i].normal, glm::dvec3(ray.direction)));
                const double apart = std::abs(expected[i].t - found[j].t) * facing / radius;
                if (apart < kSurfaceRadii) {
                    tally.apart = std::max(tally.apart, apart);
                    ++i, ++j;
                    continue;
                }
            }
            if (i + 1 < expected.size() && closePair(expected[i].t, expected[i + 1].t)) {
                tally.widest_pair = std::max(tally.widest_pair, (expected[i + 1].t - expected[i].t) / radius);
                i += 2;
            } else if (j + 1 < found.size() && closePair(found[j].t, found[j + 1].t)) {
                tally.widest_pair = std::max(tally.widest_pair, (found[j + 1].t - found[j].t) / radius);
                j += 2;
            } else {
                return false;
            }
            ++tally.pairs;
        }
        return true;
    }

    static void printCrossings(const RayInput& ray, const std::vector<reference::GlyphHit>& expected,
                               const std::vector<Crossing>& found) {
        printRay(ray, {}, {expected, false, 0});
        for (const reference::GlyphHit& hit : expected) std::printf("    expected t %.9g value %.9g\n", hit.t, hit.amplitude);
        for (const Crossing& hit : found) std::printf("    found    t %.9g value %.9g\n", hit.t, hit.value);
    }

    std::map<std::string, std::optional<BoundsEvaluator>> evaluators_;
};

TEST_F(AllHits, AreThoseOfTheReference) {
    std::mt19937 random(41);
    for (const ShLayout layout : kLayouts) {
        for (const Region region : {Region{0, 1}, Region{0, 0.02F}, Region{0, 2e-4F}}) {
            Tally tally;
            for (int i = 0; i < 2; ++i) {
                const std::vector<float> glyph = randomGlyph(random, layout);
                compare(layout, glyph, randomRays(random, 250, region.nearest, region.farthest), tally);
            }
            print(("distance up to " + std::to_string(region.farthest)).c_str(), layout, tally);
            EXPECT_EQ(tally.wrong, 0) << nameOf(layout);
            EXPECT_LE(tally.other_count, 10) << nameOf(layout);
            EXPECT_LT(tally.length, 5e-5) << nameOf(layout);
            EXPECT_GT(tally.most, std::size_t(layout.lmax / 2)) << nameOf(layout);
        }
    }
}

/// Glyphs of a brain with rays for each.
struct BrainGlyphs {
    std::vector<std::vector<float>> glyphs;
    std::vector<std::vector<RayInput>> rays;
};

BrainGlyphs phantomGlyphs(int lmax) {
    PhantomOptions options;
    options.size = 20;
    options.lmax = lmax;
    options.noise = 0.02;
    const model::ShImage image = phantomShImage(options);
    std::mt19937 random(43);
    BrainGlyphs brain;
    for (std::size_t g = 0; g < 12; ++g) {
        const float* first = &image.coefficients[g * image.voxels.size() / 12 * image.layout.count()];
        brain.glyphs.emplace_back(first, first + image.layout.count());
        brain.rays.push_back(randomRays(random, 64, 0, 0.5F));
    }
    return brain;
}

/// The rays of a file of measured glyphs that do not graze.
BrainGlyphs measuredGlyphs(const std::filesystem::path& path, int lmax) {
    const testing::NpzFile file(path);
    const ShLayout layout{lmax, false};
    const auto coefficients = file.array("coef_mrtrix"), origins = file.array("ray_o"), directions = file.array("ray_d"),
               graze = file.array("graze");
    const std::size_t glyphs = graze.shape.at(0), rays = graze.shape.at(1);
    const auto vectorAt = [](const testing::NpyArray& array, std::size_t i) {
        return glm::vec3(array.values[3 * i], array.values[3 * i + 1], array.values[3 * i + 2]);
    };
    BrainGlyphs brain;
    for (std::size_t g = 0; g < glyphs; ++g) {
        const auto first = coefficients.values.begin() + std::ptrdiff_t(g * layout.count());
        std::vector<float>& glyph = brain.glyphs.emplace_back(first, first + std::ptrdiff_t(layout.count()));
        convertSh(std::span<float>(glyph), layout, ShConvention::kTournier07, ShConvention::kDescoteaux07);
        std::vector<RayInput>& own = brain.rays.emplace_back();
        for (std::size_t r = g * rays; r < (g + 1) * rays; ++r) {
            if (graze.values[r] == 0) own.push_back({vectorAt(origins, r), -1e3F, vectorAt(directions, r), 1});
        }
    }
    return brain;
}

// The reference itself is held against the file's hits, signs and normals by MeasuredGlyphs.AgreeWithReferenceValues.
TEST_F(AllHits, OfGlyphsOfABrainAreThoseOfTheReference) {
    const char* folder = std::getenv("RADIATA_DATA");
    for (const int lmax : {4, 8, 12}) {
        std::vector<std::pair<const char*, BrainGlyphs>> sources{{"phantom", phantomGlyphs(lmax)}};
        if (folder != nullptr && *folder != 0) {
            const std::string name = "xa140_fod" + std::to_string(lmax) + "_geometry.npz";
            sources.emplace_back("measured", measuredGlyphs(std::filesystem::path(folder) / "refs" / name, lmax));
        }
        // Bands that a glyph does not have are zero.
        const ShLayout layout{lmax == 12 ? 16 : lmax, false};
        for (auto& [name, brain] : sources) {
            Tally tally;
            for (std::size_t g = 0; g < brain.glyphs.size(); ++g) {
                brain.glyphs[g].resize(layout.count(), 0);
                if (!brain.rays[g].empty()) compare(layout, brain.glyphs[g], brain.rays[g], tally);
            }
            print(name, layout, tally);
            EXPECT_EQ(tally.wrong, 0) << name << ", k " << lmax;
            EXPECT_GT(tally.rays, 700) << name << ", k " << lmax;
        }
    }
}

TEST_F(AllHits, FromInsideTheGlyphAlternateAndBeginAsTheyMust) {
    std::mt19937 random(42);
    for (const ShLayout layout : kLayouts) {
        const std::vector<float> glyph = randomGlyph(random, layout);
        const reference::ShFunction f(layout, glyph);
        std::vector<RayInput> rays = randomRays(random, 20'000, 0, 0.7F);
        for (RayInput& ray : rays) ray.origin += 2.7F * ray.direction;
        const std::vector<Crossings> found = walk(layout, glyph, rays);
        int odd = 0, wrong = 0, undecided = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const glm::dvec3 start(rays[i].origin);
            const double value = f(start), distance = glm::length(start);
            const bool inside = (rays[i].both_lobes != 0 ? std::abs(value) : value) > distance;
            const bool clear = std::abs(std::abs(value) - distance) > 1e-4;
            undecided += !clear;
            odd += found[i].at.size() % 2 == 1;
            wrong += found[i].gave_up || found[i].begins_inside != (found[i].at.size() % 2 == 1) ||
                     (clear && found[i].begins_inside != inside);
            for (std::size_t hit = 0; hit + 1 < found[i].at.size(); ++hit) {
                // Ordered to rounding, and no further crossing before the ray begins.
                wrong += !(found[i].at[hit + 1].t >= found[i].at[hit].t - 1e-5) || found[i].at[hit].t < -1e-4;
                // An entry and the exit that follows it are of one lobe.
                const bool entry = (hit % 2 == 1) == found[i].begins_inside;
                wrong += entry && (found[i].at[hit].value > 0) != (found[i].at[hit + 1].value > 0);
            }
        }
        std::printf("%s: %d of %zu rays begin inside, %d within rounding of the surface, %d wrong\n", nameOf(layout).c_str(),
                    odd, rays.size(), undecided, wrong);
        EXPECT_GT(odd, 1000);
        EXPECT_EQ(wrong, 0) << nameOf(layout);
        // The lengths as well, on a few.
        rays.resize(200);
        Tally tally;
        compare(layout, glyph, rays, tally);
        print("from inside", layout, tally);
        EXPECT_EQ(tally.wrong, 0) << nameOf(layout);
        EXPECT_LT(tally.length, 5e-5) << nameOf(layout);
    }
}

/// Peters et al. 2023, Fig. 2: band 4 allows ten hits. The search runs over random glyphs and rays near the centre.
TEST_F(AllHits, FindTheTenOfPeters2023Figure2) {
    std::mt19937 random(43);
    std::uniform_real_distribution<float> unit(-1, 1);
    const ShLayout layout{4, false};
    int tens = 0;
    for (int attempt = 0; attempt < 60; ++attempt) {
        std::vector<float> glyph(15);
        for (float& value : glyph) value = unit(random);
        glyph[0] *= 0.3F;
        std::vector<RayInput> rays = randomRays(random, 2000, 0.01F, 0.2F);
        for (RayInput& ray : rays) ray.both_lobes = 1;
        const std::vector<Crossings> found = walk(layout, glyph, rays);
        std::vector<RayInput> with_ten;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (found[i].at.size() == 10 && with_ten.size() < 5) with_ten.push_back(rays[i]);
        }
        Tally tally;
        compare(layout, glyph, with_ten, tally);
        EXPECT_EQ(tally.wrong, 0);
        EXPECT_EQ(tally.other_count, 0);
        tens += tally.rays;
    }
    std::printf("%d rays with ten hits\n", tens);
    EXPECT_GT(tens, 0);
}

TEST_F(AllHits, AreNoneOfNothingAndTwoOfASphere) {
    std::vector<float> nothing(45, 0.0F), sphere(45, 0.0F);
    sphere[0] = 3.5449077F;  // radius 1
    const std::vector<RayInput> rays{{{0, 0, 3}, 0, {0, 0, -1}, 1},    {{0.5F, 0, 3}, 0, {0, 0, -1}, 0},
                                     {{1.5F, 0, 3}, 0, {0, 0, -1}, 1}, {{0, 0, 0}, 0, {1, 0, 0}, 1},
                                     {{0, 0, 3}, 3.5F, {0, 0, -1}, 1}, {{0, 0, 3}, 4.5F, {0, 0, -1}, 1}};
    for (const Crossings& none : walk({8, false}, nothing, rays)) EXPECT_TRUE(none.at.empty() && !none.gave_up);
    const std::vector<Crossings> found = walk({8, false}, sphere, rays);
    const std::vector<std::vector<double>> expected{{2, 4}, {3 - std::sqrt(0.75), 3 + std::sqrt(0.75)}, {}, {1}, {4}, {}};
    for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_EQ(found[i].at.size(), expected[i].size()) << i;
        for (std::size_t hit = 0; hit < expected[i].size(); ++hit) EXPECT_NEAR(found[i].at[hit].t, expected[i][hit], 2e-6);
    }
}

}  // namespace
}  // namespace radiata
