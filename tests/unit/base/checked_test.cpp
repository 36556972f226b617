// Size arithmetic at the border of 64 bits.
#include "base/checked.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace radiata {
namespace {

constexpr std::uint64_t kMost = UINT64_MAX;

TEST(Checked, GivesExactResultsUpToTheBorder) {
    EXPECT_EQ(checkedMultiply(1ULL << 32, (1ULL << 32) - 1, "x"), 0xFFFFFFFF00000000ULL);
    EXPECT_EQ(checkedMultiply(0, kMost, "x"), 0U);
    EXPECT_EQ(checkedMultiply(1, kMost, "x"), kMost);
    EXPECT_EQ(checkedAdd(kMost - 1, 1, "x"), kMost);
}

TEST(Checked, NamesWhatDoesNotFit) {
    for (const auto overflow : {+[] { checkedMultiply(1ULL << 32, 1ULL << 32, "voxels of a.nii"); },
                                +[] { checkedAdd(kMost, 1, "voxels of a.nii"); }}) {
        try {
            overflow();
            FAIL() << "must throw";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), Code::kResourceExhausted);
            EXPECT_NE(std::string(error.what()).find("voxels of a.nii"), std::string::npos);
        }
    }
}

}  // namespace
}  // namespace radiata
