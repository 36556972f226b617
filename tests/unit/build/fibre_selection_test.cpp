// Selections of fibres against brute force in double on the same decoded points.
#include "build/fibre_selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <random>

#include "base/error.h"
#include "build/fiblet_code.h"
#include "build/fiblet_encode.h"
#include "build/fibre_regions.h"
#include "model/selection_text.h"
#include "reference/fibre_regions.h"

namespace radiata {
namespace {

constexpr std::size_t kFibres = 1500;

/// Random walks of a constant step within about 60 mm, from none to some hundred points.
model::Tractogram tractogram() {
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> place(-60, 60);
    model::Tractogram tracts;
    tracts.header.source = "walks";
    tracts.header.fibre_columns = {{"weight", 1}};
    tracts.header.vertex_columns = {{"along", 1}};
    tracts.fibres.clear(1, 1);
    for (std::size_t f = 0; f < kFibres; ++f) {
        glm::dvec3 p(place(random), place(random), place(random)), d(normal(random), normal(random), normal(random));
        d = glm::normalize(d);
        const std::size_t points = f % 50 == 0 ? f % 100 == 0 ? 0 : 1 : 20 + random() % 400;
        for (std::size_t i = 0; i < points; ++i) {
            tracts.fibres.points.emplace_back(p);
            tracts.fibres.vertex_values[0].push_back(static_cast<float>(i));
            d = glm::normalize(d + 0.05 * glm::dvec3(normal(random), normal(random), normal(random)));
            p += 0.2 * d;
        }
        tracts.fibres.offsets.push_back(tracts.fibres.points.size());
        tracts.fibres.fibre_values[0].push_back(static_cast<float>(f));
    }
    tracts.groups.push_back({"some", {1, 5, 70, 1499}, {}, {}});
    return tracts;
}

class FibreSelection : public testing::Test {
protected:
    static void SetUpTestSuite() {
        set_ = std::make_shared<const model::FibletSet>(encodeFiblets(tractogram(), FibletOptions{.beam = 0}));
        lines_.clear();
        for (std::uint64_t f = 0; f < set_->fibres(); ++f) lines_.push_back(decodeFibre(*set_, f));
        // Blobs on an oblique grid.
        std::mt19937_64 random(3);
        auto mask = std::make_shared<model::ScalarImage>();
        mask->size = {20, 24, 18};
        mask->voxel_to_world = glm::dmat4(4.8, 1.2, 0, 0, -1.2, 4.8, 0.5, 0, 0.2, -0.5, 5, 0, -40, -60, -45, 1);
        mask->values.resize(20 * 24 * 18);
        for (float& value : mask->values) value = random() % 3 == 0 ? 1.0F : 0.0F;
        mask_ = mask;
    }
    static void TearDownTestSuite() { set_.reset(); }

    FibreSelector selector_{set_, [](const std::string& id) {
                                if (id != "blobs") throw Error(Code::kNotFound, "there is no dataset '" + id + "'");
                                return mask_;
                            }};
    FibreBits select(const std::string& text) { return selector_.select(model::parseSelection(text)); }

    inline static std::shared_ptr<const model::FibletSet> set_;
    inline static std::shared_ptr<const model::ScalarImage> mask_;
    inline static std::vector<std::vector<glm::dvec3>> lines_;
};

TEST_F(FibreSelection, EveryRegionAndModeIsThatOfBruteForce) {
    // Equal for every fibre: the places are random, none grazes a surface to within rounding.
    const std::vector<std::string> regions{"sphere(5, -3, 2, 9)",
                                           "sphere(-30, 20, 10, 1.5)",
                                           "sphere(0, 0, 0, 75)",
                                           "box(-20, -30, -10, 15, 4, 25)",
                                           "box(-0.3, -70, -70, 0.3, 70, 70)",
                                           "ellipsoid(10, 5, -8, 30, 6, 12)",
                                           "ellipsoid(0, 0, 0, 20, 10, 0, -3, 9, 1, 0, 2, 25)",
                                           "plane(0, 0, 5, 0.3, -0.2, 1)",
                                           "plane(300, 0, 0, 1, 0, 0)",
                                           "mask(blobs)",
                                           "mask(blobs, 2)"};
    for (const std::string& text : regions) {
        SCOPED_TRACE(text);
        const model::FibreRegion region = model::parseSelection(text).regions.at(0);
        const FibreBits any = select("any " + text), all = select("all " + text), either = select("either_end " + text),
                        both = select("both_ends " + text);
        std::size_t in = 0;
        for (std::size_t f = 0; f < lines_.size(); ++f) {
            const reference::FibreInRegion expected = reference::fibreInRegion(region, mask_.get(), lines_[f]);
            ASSERT_EQ(any.test(f), expected.meets) << f;
            ASSERT_EQ(all.test(f), expected.meets && !expected.leaves) << f;
            ASSERT_EQ(either.test(f), expected.first_end || expected.last_end) << f;
            ASSERT_EQ(both.test(f), expected.first_end && expected.last_end) << f;
            in += expected.meets ? 1 : 0;
        }
        EXPECT_EQ(any.count(), in);
    }
    EXPECT_EQ(select("plane(300, 0, 0, 1, 0, 0)").count(), kFibres - 15) << "all but those without points";
    EXPECT_EQ(select("mask(blobs, 2)").count(), 0U);
}

TEST_F(FibreSelection, OrderIsThatOfTheFirstMeetingsFromOneEndOrTheOther) {
    const std::string text = "order(sphere(0, 0, 0, 20), box(10, -40, -40, 40, 40, 40), plane(0, 15, 0, 0, -1, 0))";
    const model::Selection selection = model::parseSelection(text);
    const FibreBits bits = selector_.select(selection);
    std::size_t in = 0;
    for (std::size_t f = 0; f < lines_.size(); ++f) {
        bool found = false;
        for (const bool turned : {false, true}) {
            std::vector<glm::dvec3> points = lines_[f];
            if (turned) std::reverse(points.begin(), points.end());
            std::size_t at = 0;
            bool all = !points.empty();
            for (const model::FibreRegion& region : selection.regions) {
                while (at + 1 < points.size() &&
                       reference::insideIntervals(region, nullptr, points[at], points[at + 1]).empty())
                    ++at;
                all = all && at + 1 < points.size();
            }
            found = found || all;
        }
        ASSERT_EQ(bits.test(f), found) << f;
        in += found ? 1 : 0;
    }
    EXPECT_GT(in, 10U);
}

TEST_F(FibreSelection, FiltersAreThoseOfTheValues) {
    const FibreBits length = select("length(20, 40)"), weight = select("column(weight, 100, 199.5)"),
                    largest = select("column(along, 100, 1e9, largest)"), mean = select("column(along, -inf, 50)");
    for (std::size_t f = 0; f < lines_.size(); ++f) {
        double sum = 0;
        for (std::size_t i = 1; i < lines_[f].size(); ++i) sum += glm::distance(lines_[f][i - 1], lines_[f][i]);
        // Segments keep their length but where one fiblet ends and the next begins, up to twice the bound of 10 um.
        if (std::abs(sum - 20) > 0.1 && std::abs(sum - 40) > 0.1) {
            EXPECT_EQ(length.test(f), sum > 20 && sum < 40) << f;
        }
        EXPECT_EQ(weight.test(f), f >= 100 && f < 200);
        // Values per vertex are kept to 1 / 508 of a fiblet's range of 63.
        const double last = static_cast<double>(lines_[f].size()) - 1;
        if (std::abs(last - 100) > 1) {
            EXPECT_EQ(largest.test(f), last > 100) << f;
        }
        if (std::abs(last / 2 - 50) > 1 && last >= 0) {
            EXPECT_EQ(mean.test(f), last / 2 < 50) << f;
        }
    }
    EXPECT_EQ(select("group(some)").fibres(), (std::vector<std::uint32_t>{1, 5, 70, 1499}));
    EXPECT_EQ(select("fibres(3, 1498-5000)").fibres(), (std::vector<std::uint32_t>{3, 1498, 1499}));
}

TEST_F(FibreSelection, DrawsAreTheSameForTheSameSeed) {
    const FibreBits share = select("share(0.3, 7)");
    EXPECT_EQ(share, select("share(0.3, 7)"));
    EXPECT_NE(share, select("share(0.3, 8)"));
    EXPECT_NEAR(static_cast<double>(share.count()), 0.3 * kFibres, 4 * std::sqrt(0.21 * kFibres));
    EXPECT_EQ(select("sample(100, 5)").count(), 100U);
    EXPECT_EQ(select("sample(100, 5)"), select("sample(100, 5)"));
    EXPECT_EQ(select("sample(99999)").count(), kFibres);
    EXPECT_EQ(select("share(0)").count(), 0U);
    // A larger sample of the same seed holds the smaller one, so refining never drops a fibre.
    FibreBits smaller = select("sample(100, 5)");
    EXPECT_EQ((smaller &= select("sample(400, 5)")).count(), 100U);
}

TEST_F(FibreSelection, AndOrAndNotJoinSets) {
    const std::string a = "sphere(5, -3, 2, 30)", b = "length(0, 30)", c = "fibres(0-700)";
    const FibreBits sa = select(a), sb = select(b), sc = select(c);
    const FibreBits joined = select(a + " and not " + b + " or (" + b + " and not not " + c + ")");
    for (std::size_t f = 0; f < kFibres; ++f) {
        EXPECT_EQ(joined.test(f), (sa.test(f) && !sb.test(f)) || (sb.test(f) && sc.test(f))) << f;
    }
    EXPECT_EQ(select("not everything").count(), 0U);
    EXPECT_EQ(select("not not everything").count(), kFibres);
}

TEST_F(FibreSelection, WhatIsNotThereIsNamed) {
    EXPECT_THAT([&] { select("group(left)"); },
                testing::ThrowsMessage<Error>(testing::HasSubstr("there is no group 'left'; there are: some")));
    EXPECT_THAT([&] { select("column(fa, 0, 1)"); },
                testing::ThrowsMessage<Error>(testing::HasSubstr("there is no column 'fa'; there are: weight, along")));
    EXPECT_THAT([&] { select("mask(nothing)"); }, testing::ThrowsMessage<Error>("there is no dataset 'nothing'"));
}

TEST_F(FibreSelection, KeepsWhatItCanHold) {
    FibreSelector small(
        set_, [](const std::string&) { return mask_; }, 2 * kFibres);
    const FibreBits first = small.select(model::parseSelection("sphere(0, 0, 0, 20)"));
    for (int i = 0; i < 6; ++i) small.select(model::parseSelection("sphere(0, 0, 0, " + std::to_string(21 + i) + ")"));
    EXPECT_EQ(small.select(model::parseSelection("sphere(0, 0, 0, 20)")), first);
}

/// Squares of lengths that doubles hold over- and underflow.
TEST_F(FibreSelection, HoldsForRegionsOfAnySize) {
    const auto count = [&](const std::string& text) { return select(text).count(); };
    const std::size_t all = count("sphere(0,0,0,1e5)");
    EXPECT_GT(all, 1400U);
    for (const char* radius : {"1e100", "1e155", "1e300"}) {
        const std::string r = radius;
        EXPECT_EQ(count("sphere(0,0,0," + r + ")"), all) << r;
        EXPECT_EQ(count("all sphere(0,0,0," + r + ")"), all) << r;
        EXPECT_EQ(count("ellipsoid(0,0,0," + r + ",30,20)"), count("ellipsoid(0,0,0,1e5,30,20)")) << r;
    }
    for (const char* radius : {"1e-100", "1e-155", "1e-300", "1e-320"})
        EXPECT_EQ(count("sphere(500,0,0," + std::string(radius) + ")"), 0U) << radius;
    const std::size_t half = count("plane(0,0,0,1,0,0)");
    EXPECT_GT(all, half);
    for (const char* length : {"1e-320", "1e-200", "1e-100", "1e200", "1e308"})
        EXPECT_EQ(count("plane(0,0,0," + std::string(length) + ",0,0)"), half) << length;
}

}  // namespace
}  // namespace radiata
