// What selections may be written like, and what is said of those that are not.
#include "model/selection_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "base/error.h"

namespace radiata::model {
namespace {

using Kind = Selection::Kind;

std::string failure(const std::string& text) {
    try {
        parseSelection(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), Code::kInvalidArgument);
        return error.what();
    }
    return "no failure";
}

TEST(SelectionText, NotBindsBeforeAndBeforeOr) {
    const Selection s = parseSelection("not group(a) and length(1,2) or everything");
    ASSERT_EQ(s.kind, Kind::kOr);
    ASSERT_EQ(s.children.size(), 2U);
    EXPECT_EQ(s.children[0].kind, Kind::kAnd);
    EXPECT_EQ(s.children[0].children.at(0).kind, Kind::kNot);
    EXPECT_EQ(parseSelection("(not (group(a)) and (length(1,2))) or(everything)"), s);
    EXPECT_EQ(parseSelection("group(a) and group(b) and group(c)").children.size(), 3U);
}

TEST(SelectionText, RegionsHaveTheirNumbersAndModes) {
    const Selection s = parseSelection("both_ends sphere(1, -2.5, 3e1, 4)");
    EXPECT_EQ(s.mode, RegionMode::kBothEnds);
    EXPECT_EQ(s.regions.at(0).centre, glm::dvec3(1, -2.5, 30));
    EXPECT_EQ(s.regions.at(0).axes, glm::dmat3(4.0));
    EXPECT_EQ(parseSelection("any sphere(0,0,0,2)"), parseSelection("sphere(0,0,0,2)"));
    EXPECT_EQ(parseSelection("ellipsoid(0,0,0,2,2,2)"), parseSelection("sphere(0,0,0,2)"));
    EXPECT_EQ(parseSelection("box(1,2,3,-1,-2,-3)"), parseSelection("box(-1,-2,-3,1,2,3)"));
    const Selection mask = parseSelection("all mask(csf_1, 0.25)");
    EXPECT_EQ(mask.regions.at(0).dataset, "csf_1");
    EXPECT_EQ(mask.regions.at(0).threshold, 0.25);
    EXPECT_EQ(parseSelection("order(sphere(0,0,0,1), mask(a), plane(0,0,0,0,0,1))").regions.size(), 3U);
}

TEST(SelectionText, FiltersHaveTheirBoundsNamesAndSeeds) {
    const Selection column = parseSelection("column(\"my column (mm)\", -inf, 3, largest)");
    EXPECT_EQ(column.name, "my column (mm)");
    EXPECT_EQ(column.part, ColumnPart::kLargest);
    EXPECT_TRUE(std::isinf(column.low));
    EXPECT_EQ(parseSelection("group(AF-left.1)").name, "AF-left.1");
    EXPECT_EQ(parseSelection("fibres(7, 10-12)").ranges,
              (std::vector<std::pair<std::uint32_t, std::uint32_t>>{{7, 7}, {10, 12}}));
    EXPECT_EQ(parseSelection("sample(1000, 18446744073709551615)").seed, ~std::uint64_t{0});
    EXPECT_EQ(parseSelection("share(0.5)").seed, 1U);
}

TEST(SelectionText, WhatIsWrongIsShownWhereItStands) {
    EXPECT_EQ(failure("sphere(1, 2, 3)"), "selection, at character 7: '(1, 2, 3)' where sphere(x, y, z, radius) should be");
    EXPECT_EQ(failure("group(a) group(b)"), "selection, at character 10: 'group(b)' where 'and', 'or' or the end should be");
    EXPECT_THAT(failure(""), testing::HasSubstr("the text ends where a region or filter (sphere, box,"));
    EXPECT_THAT(failure("sphere(1, 2, 3, -4)"), testing::HasSubstr("a radius above 0"));
    EXPECT_THAT(failure("sphere(1, 2, nan, 4)"), testing::HasSubstr("'nan, 4)' where a number"));
    EXPECT_THAT(failure("sphere(1, 2, inf, 4)"), testing::HasSubstr("a finite number"));
    EXPECT_THAT(failure("ellipsoid(0,0,0, 1,0,0, 2,0,0, 0,0,1)"), testing::HasSubstr("three half axes that span space"));
    EXPECT_THAT(failure("plane(0,0,0,0,0,0)"), testing::HasSubstr("a normal that is not zero"));
    EXPECT_THAT(failure("length(30, 20)"), testing::HasSubstr("a higher bound than the lower one"));
    EXPECT_THAT(failure("share(1.5)"), testing::HasSubstr("a share from 0 to 1"));
    EXPECT_THAT(failure("sample(1.5)"), testing::HasSubstr("a count of fibres"));
    EXPECT_THAT(failure("fibres(9-3)"), testing::HasSubstr("a range that ascends"));
    EXPECT_THAT(failure("order(sphere(0,0,0,1))"), testing::HasSubstr("a second region"));
    EXPECT_THAT(failure("group(\"a"), testing::HasSubstr("a name that ends"));
    EXPECT_THAT(failure("(((everything)"), testing::HasSubstr("')'"));
    EXPECT_THAT(failure(std::string(1000, '(').append("everything")), testing::HasSubstr("nested less than 64 deep"));
    EXPECT_THAT(failure(std::string(70000, ' ')), testing::HasSubstr("at most 65536 are read"));
}

TEST(SelectionText, AnyTextIsReadOrRefused) {
    std::mt19937 random(5);
    const std::vector<std::string> parts{"sphere", "(",   ")",     ",",         "1",    "-2",    "and", "or",
                                         "not",    "box", "group", "\"",        "any",  "order", "inf", " ",
                                         "fibres", "9-3", "\xff",  "ellipsoid", "mask", "share"};
    int read = 0;
    for (int i = 0; i < 20000; ++i) {
        std::string text;
        for (auto n = random() % 12; n > 0; --n) text += parts[random() % parts.size()] + (random() % 2 == 0 ? " " : "");
        read += failure(text) == "no failure" ? 1 : 0;
    }
    EXPECT_LT(read, 20000);
}

TEST(SelectionText, ARegionsTextNamesItExactly) {
    for (const char* text : {"sphere(0.1, 2, 3, 4)", "box(0,0,0,1,1,1e-9)", "plane(1,2,3,0,0,0.3)", "mask(\"a b\", 0.7)"}) {
        const FibreRegion region = parseSelection(text).regions.at(0);
        EXPECT_EQ(parseSelection(regionText(region)).regions.at(0), region) << text;
    }
    EXPECT_NE(regionText(parseSelection("sphere(0,0,0,1)").regions[0]),
              regionText(parseSelection("sphere(0,0,0,1.0000000000000002)").regions[0]));
}

TEST(SelectionText, RegionsAloneAreNotFilters) {
    EXPECT_EQ(parseRegion("sphere(1,2,3,4)").centre, glm::dvec3(1, 2, 3));
    try {
        parseRegion("length(1,2)");
        ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(),
                    testing::HasSubstr("'length(1,2)' where a region (sphere, box, ellipsoid, plane, mask, mesh)"));
    }
}

}  // namespace
}  // namespace radiata::model
