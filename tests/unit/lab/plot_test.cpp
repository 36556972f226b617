// Pareto front, quantiles, axes and the writer of SVG.
#include "tools/lab/plot.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tools/lab/axis.h"
#include "tools/lab/statistics.h"

namespace radiata::lab {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST(Pareto, KeepsThePointsThatNoOtherBeats) {
    //  fast and bad, beaten by a point of equal time, middle, beaten in both, slow and exact, slower and as exact
    const std::vector<PlotPoint> points{{1, 9, ""}, {1, 10, ""}, {3, 4, ""}, {5, 6, ""}, {8, 0, ""}, {9, 0, ""}};
    EXPECT_EQ(paretoFront(points), (std::vector<std::size_t>{0, 2, 4}));
    EXPECT_TRUE(paretoFront({}).empty());
}

TEST(Pareto, OfEqualPointsTheFirstCounts) { EXPECT_EQ(paretoFront({{2, 2, ""}, {2, 2, ""}}), std::vector<std::size_t>{0}); }

TEST(Quantile, IsLinearBetweenValues) {
    EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2);
    EXPECT_EQ(quantile({1, 2, 3, 4}, 0.5), 2.5);
    EXPECT_EQ(quantile({1, 2, 3, 4}, 1), 4);
    EXPECT_EQ(quantile({}, 0.5), 0);
}

TEST(Axis, LogarithmicAxisGivesEqualRatiosEqualRoom) {
    const Axis axis({1, 10, 1000}, true);
    EXPECT_NEAR(axis.place(100) - axis.place(10), axis.place(1000) - axis.place(100), 1e-12);
    EXPECT_GT(axis.place(1), 0);
    EXPECT_LT(axis.place(1000), 1);
}

TEST(Axis, ZerosStandBelowTheSmallestValueOfALogarithmicAxis) {
    const Axis axis({0, 1e-7, 1}, true);
    EXPECT_LT(axis.place(0), axis.place(1e-7) - 0.05);
    const std::vector<Tick> ticks = axis.ticks();
    EXPECT_EQ(ticks.front().label, "0");
    EXPECT_NEAR(ticks.front().at, axis.place(0), 1e-12);
}

TEST(Axis, TicksAreInsideAndNamed) {
    for (const bool logarithmic : {false, true}) {
        for (const double high : {0.3, 7.0, 2e5}) {
            const std::vector<Tick> ticks = Axis({0.2, high}, logarithmic).ticks();
            EXPECT_GE(std::count_if(ticks.begin(), ticks.end(), [](const Tick& tick) { return !tick.label.empty(); }), 2);
            for (const Tick& tick : ticks) {
                EXPECT_GE(tick.at, 0);
                EXPECT_LE(tick.at, 1);
            }
        }
    }
}

TEST(Svg, HasEveryPointItsNameAndTheFront) {
    const Plot plot{
        "a < b", "time", "error", true, true, true, {{"family", {{1, 0, "exact & slow"}, {2, 1e-3, "fast"}}, false}}};
    const std::string picture = svg("heading", {plot, plot});
    EXPECT_EQ(count(picture, "exact &amp; slow"), 2U);
    EXPECT_EQ(count(picture, "a &lt; b"), 2U);
    EXPECT_EQ(count(picture, "<circle"), 8U);  // each point in the plot and in the list
    EXPECT_EQ(count(picture, "Pareto front"), 2U);
    EXPECT_EQ(count(picture, "<svg"), count(picture, "</svg>"));
    EXPECT_EQ(picture.find("nan"), std::string::npos);
}

TEST(Svg, PointsWithoutNamesAreListedByTheirCurve) {
    const Plot plot{"t", "x", "y", false, false, false, {{"curve", {{1, 2, ""}, {3, 4, ""}}, true}}};
    const std::string picture = svg("heading", {plot});
    EXPECT_EQ(count(picture, ">curve<"), 1U);
    EXPECT_EQ(count(picture, "<polyline"), 2U);  // the axes and the curve
    EXPECT_EQ(picture.find("Pareto"), std::string::npos);
}

}  // namespace
}  // namespace radiata::lab
