// Counting and ordering of coefficients.
#include "math/sh_layout.h"

#include <set>

#include <gtest/gtest.h>

namespace radiata {
namespace {

TEST(ShLayout, EvenBasisHasTheCountsOfTheField) {
    const std::size_t counts[] = {1, 6, 15, 28, 45, 66, 91, 120, 153};
    for (int i = 0; i < 9; ++i) {
        const ShLayout expected{2 * i, false};
        EXPECT_EQ(expected.count(), counts[i]);
        EXPECT_EQ(shLayoutOfCount(counts[i]), expected);
    }
}

TEST(ShLayout, FullBasisHasSquareCountsAlsoForOddBands) {
    for (int lmax = 0; lmax <= kLmaxLimit; ++lmax) {
        const auto count = static_cast<std::size_t>((lmax + 1) * (lmax + 1));
        const ShLayout expected{lmax, true};
        EXPECT_EQ(expected.count(), count);
        EXPECT_EQ(shLayoutOfCount(count, true), expected);
        if (count > 1) {
            EXPECT_EQ(shLayoutOfCount(count), expected);
            EXPECT_EQ(shLayoutOfCount(count, false), std::nullopt);
        }
    }
    EXPECT_EQ(shLayoutOfCount(1), (ShLayout{0, false}));
}

TEST(ShLayout, OtherCountsHaveNoLayout) {
    for (const std::size_t count : {0, 2, 3, 5, 7, 10, 21, 46, 152, 154, 190, 290, 324}) {
        EXPECT_EQ(shLayoutOfCount(count), std::nullopt) << count;
    }
    EXPECT_EQ(shLayoutOfCount(15, true), std::nullopt);
}

TEST(ShLayout, IndexRunsThroughAllCoefficientsInOrder) {
    for (const bool full : {false, true}) {
        const ShLayout layout{8, full};
        std::size_t expected = 0;
        for (int l = 0; l <= layout.lmax; l += layout.step()) {
            for (int m = -l; m <= l; ++m) EXPECT_EQ(layout.index(l, m), expected++) << l << ' ' << m;
        }
        EXPECT_EQ(expected, layout.count());
    }
}

}  // namespace
}  // namespace radiata
