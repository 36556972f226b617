// Encoding of streamlines as fiblets: what is decoded by the twin in double precision lies within the bound that was asked for,
// the header's errors are the measured ones within 0.15 um, and what cannot be held is refused by the fibre's name.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>

#include "base/error.h"
#include "build/fiblet_code.h"
#include "build/fiblet_encode.h"
#include "build/fiblet_source.h"
#include "build/fiblet_walk.h"
#include "io/tractogram.h"
#include "reference/fiblet.h"
#include "support/random_fibres.h"

namespace radiata {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// All points of all fibres by the twin, the shared points of neighbouring fiblets once.
std::vector<std::vector<glm::dvec3>> decodeByTwin(const model::FibletSet& set) {
    std::vector<std::vector<glm::dvec3>> fibres(set.fibres());
    for (std::uint64_t f = 0; f < set.fibres(); ++f) {
        for (std::uint32_t i = set.fibre_first[f]; i < set.fibre_first[f + 1]; ++i) {
            const model::FibletHead& h = set.heads[set.fibre_fiblets[i]];
            const std::uint32_t first = set.pages[set.fibre_fiblets[i] / shader::FIBLET_PAGE].first_word + model::fibletWord(h);
            auto points = reference::fibletPoints({h.place0, h.place1, h.direction, h.fibre, h.shape},
                                                  std::span(set.codes).subspan(first), set.codec.cell_mm, set.codec.step_mm,
                                                  set.codec.cap_ratio);
            if (!model::fibletIsLast(h)) points.pop_back();
            for (const glm::dvec3& p : points) fibres[f].push_back(set.origin_mm + p);
        }
    }
    return fibres;
}

/// Encodes and holds everything against the input. \return largest error, um
double check(const test::Fibres& fibres, const FibletOptions& options, const char* name) {
    const model::FibletSet set = encodeFiblets(fibres.points, fibres.offsets, options);
    EXPECT_FALSE(set.walked) << name;
    EXPECT_EQ(set.fibres() + 1, fibres.offsets.size()) << name;
    EXPECT_EQ(set.points, fibres.points.size()) << name;
    const auto decoded = decodeByTwin(set);
    double largest = 0, sum = 0;
    for (std::size_t f = 0; f < decoded.size(); ++f) {
        EXPECT_EQ(decoded[f].size(), fibres.offsets[f + 1] - fibres.offsets[f]) << name << ", fibre " << f;
        for (std::size_t i = 0; i < decoded[f].size(); ++i) {
            const double error = 1e3 * glm::distance(decoded[f][i], glm::dvec3(fibres.points[fibres.offsets[f] + i]));
            largest = std::max(largest, error);
            sum += error;
        }
    }
    const double mean = fibres.points.empty() ? 0 : sum / double(fibres.points.size());
    std::printf("%s: mean %.3f, largest %.3f um; header %.3f, %.3f\n", name, mean, largest, set.errors.mean_um,
                set.errors.max_um);
    EXPECT_LE(largest, options.bound_um + 0.15) << name;
    // Points where fiblets meet are measured twice by the header, once here, so the means differ by a little.
    EXPECT_NEAR(mean, set.errors.mean_um, 0.05 * mean + 0.15) << name;
    EXPECT_LE(largest, set.errors.max_um + 0.15) << name;
    return largest;
}

TEST(FibletEncode, HoldsTheBoundOnRandomFibres) {
    const test::Fibres gentle = test::randomFibres(1, 60, 500, 0.1, 0.13);
    for (const double bound : {0.5, 1.0, 3.0, 10.0, 50.0}) check(gentle, {.bound_um = bound}, "gentle, searched");
    check(gentle, {.beam = 0, .least_width = 8}, "gentle, fast");
    for (const std::uint32_t width : {4U, 6U, 8U, 16U})
        check(gentle, {.bound_um = 100, .least_width = width}, "gentle, by width");
    check(test::randomFibres(2, 60, 300, 0.1, 1.05), {}, "turns up to 60 degrees");
    check(test::randomFibres(3, 30, 200, 1.0, 0.5), {.bound_um = 20}, "steps of 1 mm");
    check(test::randomFibres(4, 20, 200, 0.1, 3.1415), {.bound_um = 30}, "any turn");
}

TEST(FibletEncode, MoreBeginningsAndMoreBitsMeanSmallerErrors) {
    const test::Fibres fibres = test::randomFibres(5, 40, 500, 0.1, 0.13);
    const auto mean = [&](std::uint32_t beam, std::uint32_t width) {
        return encodeFiblets(fibres.points, fibres.offsets, {.bound_um = 1000, .beam = beam, .least_width = width})
            .errors.mean_um;
    };
    EXPECT_LT(mean(8, 4), 0.6 * mean(0, 4));
    EXPECT_LT(mean(32, 4), mean(8, 4));
    EXPECT_LT(mean(8, 6), 0.6 * mean(8, 4));
    EXPECT_LT(mean(8, 8), 0.6 * mean(8, 6));
    EXPECT_LT(mean(8, 16), 0.3);
}

TEST(FibletEncode, TakesOddFibres) {
    std::mt19937 random(6);
    test::Fibres fibres;
    fibres.add({});
    fibres.add({glm::vec3(1, 2, 3)});
    fibres.add({glm::vec3(1, 2, 3), glm::vec3(1.1F, 2, 3)});
    fibres.add({glm::vec3(1, 2, 3), glm::vec3(0.9F, 2, 3)});
    fibres.add({glm::vec3(1, 2, 3), glm::vec3(1.03F, 2, 3)});
    std::vector<glm::vec3> straight;
    for (int i = 0; i < 64; ++i) straight.emplace_back(0, 0, -0.1F * float(i));
    fibres.add(straight);
    straight.emplace_back(0, 0.07F, -6.3F);  // a shortened last segment that begins a fiblet
    fibres.add(straight);
    fibres.add({});
    fibres.add(test::randomFibre(random, 100'000, 0.1, 0.05));
    check(fibres, {}, "odd fibres");
    check({}, {}, "nothing");
}

TEST(FibletEncode, RefusesWhatItCannotHoldByTheFibresName) {
    const auto refusal = [](const test::Fibres& fibres, const FibletOptions& options) -> std::string {
        try {
            encodeFiblets(fibres.points, fibres.offsets, options);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), Code::kInvalidArgument);
            return error.what();
        }
        return "nothing refused";
    };
    test::Fibres fibres = test::randomFibres(7, 3, 100, 0.1, 0.1);
    std::mt19937 random(8);
    fibres.add(test::randomFibre(random, 300, 0.1, 3.0));
    EXPECT_THAT(refusal(fibres, {.bound_um = 0.3}),
                AllOf(HasSubstr("fibre"), HasSubstr("cannot be encoded within 0.3"), HasSubstr("least error")));
    test::Fibres far = test::randomFibres(9, 2, 50, 0.1, 0.1);
    far.add({glm::vec3(90'000, 0, 0)});
    EXPECT_THAT(refusal(far, {}),
                AllOf(HasSubstr("fibre 2 reaches (90000.0, 0.0, 0.0) mm"), HasSubstr("each 85.8733 um wide")));
    test::Fibres long_one;
    long_one.add(std::vector<glm::vec3>(63 * 4096 + 2, glm::vec3(0)));
    for (std::size_t i = 0; i < long_one.points.size(); ++i) long_one.points[i].x = float(i % 2);
    EXPECT_THAT(refusal(long_one, {.bound_um = 1e6}), AllOf(HasSubstr("fibre 0"), HasSubstr("258050 points")));
    test::Fibres walk;  // whose steps vary
    walk.add({glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(3, 0, 0)});
    walk.add(std::vector<glm::vec3>(100, glm::vec3(0)));
    for (std::size_t i = 3; i < walk.points.size(); ++i) walk.points[i].x = float(1000 * (i % 2));
    EXPECT_THAT(refusal(walk, {.step_mm = 0.1}),
                AllOf(HasSubstr("fibre 1 has 100 points on 99000 mm"), HasSubstr("at most 258048 steps"),
                      HasSubstr("those of 0.1 mm would be 990000 of it; take steps of 0.384 mm or more")));
    fibres.points[5].y = NAN;
    EXPECT_THAT(refusal(fibres, {}), AllOf(HasSubstr("point 5 of fibre 0"), HasSubstr("not finite")));
    EXPECT_THAT(refusal({}, {.bound_um = 0}), HasSubstr("above 0"));
}

/// Down to the bound that no search holds: the nearest codes alone fail long before, on fibres with any turn.
TEST(FibletEncode, FastSettingsHoldWhatCarefulOnesDo) {
    const test::Fibres wild = test::randomFibres(4, 10, 150, 0.1, 3.1415);
    const auto holds = [&](const FibletOptions& options) {
        try {
            return encodeFiblets(wild.points, wild.offsets, options).errors.max_um <= options.bound_um;
        } catch (const Error&) {
            return false;
        }
    };
    double bound = 30;
    for (; holds({.bound_um = bound}); bound *= 0.7) {
        EXPECT_TRUE(holds({.bound_um = bound, .beam = 0, .least_width = 8})) << bound;
    }
    std::printf("nothing holds %.2f um\n", bound);
    EXPECT_LT(bound, 10);
}

TEST(FibletEncode, GivesEqualBytesAndBoxesThatHoldAllPoints) {
    const test::Fibres fibres = test::randomFibres(10, 200, 400, 0.1, 0.2);
    const model::FibletSet set = encodeFiblets(fibres.points, fibres.offsets, {}),
                           again = encodeFiblets(fibres.points, fibres.offsets, {});
    EXPECT_EQ(set.codes, again.codes);
    EXPECT_EQ(set.fibre_fiblets, again.fibre_fiblets);
    ASSERT_GT(set.pages.size(), 5U);
    for (std::uint32_t f = 0; f < set.heads.size(); ++f) {
        const shader::FibletPage& page = set.pages[f / shader::FIBLET_PAGE];
        glm::vec3 offsets[64];
        const std::uint32_t count = decodeOffsets(
            set.heads[f], set.codes.data() + page.first_word + model::fibletWord(set.heads[f]), set.codec, offsets);
        const glm::vec3 unit = (page.high - page.low) / float(shader::FIBLET_BOX_STEPS),
                        start(fibletStart(set.heads[f], set.codec));
        for (int axis = 0; axis < 3; ++axis) {
            const float low = page.low[axis] + unit[axis] * float(set.boxes[f].low >> (10 * axis) & 1023);
            const float high = page.low[axis] + unit[axis] * float(set.boxes[f].high >> (10 * axis) & 1023);
            for (std::uint32_t i = 0; i < count; ++i) {
                ASSERT_LE(low, start[axis] + offsets[i][axis] - 1e-4F);
                ASSERT_GE(high, start[axis] + offsets[i][axis] + 1e-4F);
            }
        }
    }
}

TEST(FibletWalk, KeepsItsStepAndTheLastPoint) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (int n = 0; n < 200; ++n) {
        std::vector<glm::vec3> line;
        for (int i = 0; i < 1 + n % 50; ++i) line.emplace_back(5 * unit(random), 5 * unit(random), 5 * unit(random));
        if (n % 7 == 0) line.insert(line.begin() + line.size() / 2, 3, line[line.size() / 2]);
        const double step = 0.2 + n * 0.01;
        Walk out;
        walk(line, step, out);
        ASSERT_EQ(out.points.size(), out.places.size());
        EXPECT_EQ(out.points.front(), line.front());
        EXPECT_LT(glm::distance(out.points.back(), line.back()), 1e-5 * step + 1e-9);
        EXPECT_LE(out.max_error_mm, step);
        for (std::size_t i = 0; i < out.points.size(); ++i) {
            const auto vertex = std::size_t(out.places[i]);
            const float t = float(out.places[i] - double(vertex));
            const glm::vec3 on_line = t > 0 ? glm::mix(line[vertex], line[vertex + 1], t) : line[vertex];
            EXPECT_LT(glm::distance(out.points[i], on_line), 1e-5F);
            if (i > 0) {
                EXPECT_GT(out.places[i], out.places[i - 1]);
            }
            if (i > 0 && i + 1 < out.points.size()) {
                EXPECT_NEAR(glm::distance(out.points[i], out.points[i - 1]), step, 1e-5);
            }
        }
    }
}

TEST(FibletWalk, IsUsedWhereStepsVaryAndKeepsVerticesWithinItsBound) {
    std::mt19937 random(12);
    std::uniform_real_distribution<float> length(0.2F, 3.0F);
    test::Fibres fibres;
    for (int f = 0; f < 30; ++f) {
        std::vector<glm::vec3> fibre = test::randomFibre(random, 2 + f, 1.0, 0.3);
        for (std::size_t i = fibre.size() - 1; i > 0; --i) fibre[i] -= fibre[i - 1];
        for (std::size_t i = 1; i < fibre.size(); ++i) fibre[i] = fibre[i - 1] + length(random) * fibre[i];
        fibres.add(fibre);
    }
    fibres.add({glm::vec3(1), glm::vec3(1)});
    const model::FibletSet set = encodeFiblets(fibres.points, fibres.offsets, {.bound_um = 10, .walk_bound_um = 50});
    EXPECT_TRUE(set.walked);
    EXPECT_LE(set.walk_errors.max_um, 50);
    EXPECT_LE(set.errors.max_um, 10);
    const auto decoded = decodeByTwin(set);
    for (std::size_t f = 0; f < decoded.size(); ++f) {
        for (std::uint64_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i) {
            double nearest = glm::distance(decoded[f][0], glm::dvec3(fibres.points[i]));
            for (std::size_t k = 1; k < decoded[f].size(); ++k) {
                const glm::dvec3 a = decoded[f][k - 1], d = decoded[f][k] - a;
                const double t = std::clamp(glm::dot(glm::dvec3(fibres.points[i]) - a, d) / glm::dot(d, d), 0.0, 1.0);
                nearest = std::min(nearest, glm::distance(glm::dvec3(fibres.points[i]), a + t * d));
            }
            EXPECT_LE(1e3 * nearest, 60.2) << "fibre " << f;
        }
        EXPECT_LE(1e3 * glm::distance(decoded[f].back(), glm::dvec3(fibres.points[fibres.offsets[f + 1] - 1])), 10.2);
    }
}

/// Fibres of 1 mm steps that turn back: the one sharp turn asks for codes of all directions, too far apart for such a step.
test::Fibres turningBack(float last) {
    test::Fibres fibres;
    std::vector<glm::vec3> fibre;
    for (int i = 0; i <= 20; ++i) fibre.emplace_back(i <= 10 ? i : 20 - i, 0.3F * std::sin(0.5F * float(i)), 0.02F * float(i));
    for (std::size_t i = 1; i < fibre.size(); ++i) {
        fibre[i] = fibre[i - 1] + glm::normalize(fibre[i] - fibre[i - 1]) * (i == 5 ? last : 1.0F);
    }
    fibres.add(fibre);
    return fibres;
}

TEST(FibletWalk, TakesFinerStepsWhereNoCodesHoldTheBound) {
    const test::Fibres uneven = turningBack(0.9F), even = turningBack(1);
    EXPECT_THROW(encodeFiblets(uneven.points, uneven.offsets, {.bound_um = 8, .walk_bound_um = 1000, .step_mm = 1}),
                 UnheldBound);
    const model::FibletSet walked = encodeFiblets(uneven.points, uneven.offsets, {.bound_um = 8, .walk_bound_um = 1000});
    EXPECT_LE(walked.codec.step_mm, 0.5F);
    EXPECT_LE(walked.errors.max_um, 8);
    EXPECT_LE(walked.walk_errors.max_um, 1000);
    // Even steps keep their points or are refused, unless it may be otherwise.
    EXPECT_THROW(encodeFiblets(even.points, even.offsets, {.bound_um = 8, .walk_bound_um = 1000}), UnheldBound);
    const model::FibletSet rather =
        encodeFiblets(even.points, even.offsets, {.bound_um = 8, .walk_bound_um = 1000, .walk_rather = true});
    EXPECT_TRUE(rather.walked);
    EXPECT_LE(rather.codec.step_mm, 0.5F);
    EXPECT_LE(rather.errors.max_um, 8);
}

TEST(FibletWalk, HoldsItsBoundForFewLongSegmentsThatTurnBack) {
    test::Fibres fibres;
    fibres.add(
        {glm::vec3(0), glm::vec3(14.48F, 0.1F, 0), glm::vec3(0.3F, 0, 0.2F), glm::vec3(19, 2, 1), glm::vec3(18.7F, 2, 1)});
    const model::FibletSet set = encodeFiblets(fibres.points, fibres.offsets, {.bound_um = 10, .walk_bound_um = 20});
    EXPECT_TRUE(set.walked);
    EXPECT_LE(set.walk_errors.max_um, 20);
    EXPECT_LE(set.errors.max_um, 10);
}

TEST(FibletSource, GivesPointsColumnsAndGroupsBack) {
    std::mt19937 random(13);
    model::Tractogram tractogram;
    tractogram.header.source = tractogram.header.format = "memory";
    tractogram.header.vertex_columns = {{"fa", 1}, {"colour", 3}};
    tractogram.header.fibre_columns = {{"weight", 2}};
    test::Fibres fibres = test::randomFibres(14, 20, 200, 0.1, 0.1);
    fibres.add({});
    tractogram.fibres.points = fibres.points;
    tractogram.fibres.offsets = fibres.offsets;
    tractogram.fibres.vertex_values.resize(2);
    for (std::size_t i = 0; i < fibres.points.size(); ++i) {
        tractogram.fibres.vertex_values[0].push_back(std::sin(0.01F * float(i)));
        for (int k = 0; k < 3; ++k) tractogram.fibres.vertex_values[1].push_back(float(i % 50 + 100 * k));
    }
    tractogram.fibres.vertex_values[0][3] = NAN;
    tractogram.fibres.fibre_values = {std::vector<float>(42)};
    for (int i = 0; i < 42; ++i) tractogram.fibres.fibre_values[0][i] = float(i) / 3;
    tractogram.groups = {{"left", {0, 3, 20}, {{"n", 1}}, {{7.5F}}}};
    const model::FibletSet set = encodeFiblets(tractogram, {.bound_um = 5});
    auto source = sourceOf(set);
    const model::Tractogram back = model::readAll(*source);
    EXPECT_EQ(back.header.vertex_columns, tractogram.header.vertex_columns);
    EXPECT_EQ(back.header.fibre_columns, tractogram.header.fibre_columns);
    EXPECT_EQ(back.fibres.offsets, tractogram.fibres.offsets);
    EXPECT_EQ(back.fibres.fibre_values, tractogram.fibres.fibre_values);
    ASSERT_EQ(back.groups.size(), 1U);
    EXPECT_EQ(back.groups[0].fibres, tractogram.groups[0].fibres);
    EXPECT_EQ(back.groups[0].values, tractogram.groups[0].values);
    for (std::size_t i = 0; i < fibres.points.size(); ++i) {
        ASSERT_LE(glm::distance(back.fibres.points[i], fibres.points[i]), 5.2e-3F);
        if (i != 3) {
            ASSERT_NEAR(back.fibres.vertex_values[0][i], tractogram.fibres.vertex_values[0][i], 0.65 / 508);
        }
        for (int k = 0; k < 3; ++k)
            ASSERT_NEAR(back.fibres.vertex_values[1][3 * i + k], tractogram.fibres.vertex_values[1][3 * i + k], 0.1);
    }
    EXPECT_TRUE(std::isnan(back.fibres.vertex_values[0][3]));
}

TEST(FibletEncode, HoldsItsFiguresOnRealStreamlines) {
    // Without the real data: streamlines that turn as those of the same tracking algorithm do.
    test::Fibres fibres = test::randomFibres(15, 60, 1800, 0.1, 7.2 * 3.14159265 / 180);
    const char* folder = std::getenv("RADIATA_DATA");
    if (folder) {
        auto source = io::openTractogram(std::filesystem::path(folder) / "tracts" / "sag_ifod1_1000.tck");
        model::FibreBatch batch;
        source->read(batch, 100'000);
        test::Fibres real{batch.points, batch.offsets};
        check(real, {}, "real, compact");
        check(real, {.beam = 0, .least_width = 8}, "real, fast");
    }
    const model::FibletSet set = encodeFiblets(fibres.points, fibres.offsets, {});
    const double bytes = 24.0 * double(set.heads.size()) + 4.0 * double(set.codes.size()) + 36.0 * double(set.pages.size()) +
                         4.0 * double(set.fibre_first.size());
    std::printf("%.3f bytes a point, mean %.2f um\n", bytes / double(set.points), set.errors.mean_um);
    EXPECT_LE(bytes / double(set.points), 0.95);
    EXPECT_LE(set.errors.mean_um, 3);
}

}  // namespace
}  // namespace radiata
