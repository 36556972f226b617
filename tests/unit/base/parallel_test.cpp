// Every index exactly once, whatever the block size, and exceptions reach the caller.
#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace radiata {
namespace {

TEST(ParallelFor, CoversEveryIndexExactlyOnce) {
    for (const std::size_t count : {0UL, 1UL, 2UL, 999UL, 1000UL, 1001UL}) {
        for (const std::size_t block : {0UL, 1UL, 7UL, 1000UL, 5000UL}) {
            std::vector<std::atomic<int>> visits(count);
            parallelFor(count, block, [&](std::size_t begin, std::size_t end) {
                EXPECT_LT(begin, end);
                for (std::size_t i = begin; i < end; ++i) ++visits[i];
            });
            for (const auto& visit : visits) EXPECT_EQ(visit, 1) << count << " in blocks of " << block;
        }
    }
}

TEST(ParallelFor, BlocksAreNoLargerThanAsked) {
    std::atomic<std::size_t> largest{0};
    parallelFor(1003, 10, [&](std::size_t begin, std::size_t end) {
        std::size_t seen = largest;
        while (seen < end - begin && !largest.compare_exchange_weak(seen, end - begin)) {
        }
    });
    EXPECT_EQ(largest, 10U);
}

TEST(ParallelFor, ThrowsWhatABodyThrewAndStartsNoFurtherBlocks) {
    std::atomic<int> blocks{0};
    EXPECT_THROW(parallelFor(1'000'000, 1,
                             [&](std::size_t begin, std::size_t) {
                                 ++blocks;
                                 if (begin == 3) throw std::runtime_error("three");
                             }),
                 std::runtime_error);
    EXPECT_LT(blocks, 1'000'000);
}

}  // namespace
}  // namespace radiata
