// The memory of texels: rows for those alone that were needed, which stay where they are when more of their brick are, what
// gives way within a budget, and that what is counted is what is allocated.
#include <numeric>
#include <set>
#include <span>

#include "gpu/light/lattice_fixture.h"

namespace radiata {
namespace {

using render::LatticePool;

constexpr std::uint64_t kPayload = 12;                                ///< bytes
constexpr std::uint64_t kSlot = 64 * 8 + 4, kRow = kPayload + 4 + 4;  ///< bytes of a brick, and of a texel in it

class LatticePoolTest : public test::LatticeTest {
protected:
    std::uint64_t admit(LatticePool& pool, const std::vector<std::pair<std::uint32_t, std::uint64_t>>& wants) {
        pool.beginRequest();
        for (const auto& [brick, texels] : wants) pool.want(brick, brick + 1, texels);
        return pool.admit(run().recorder);
    }
    template <typename T>
    std::vector<T> read(const gpu::Buffer& buffer) {
        std::vector<T> values(buffer.sizeBytes() / sizeof(T));
        gpu::download(device(), buffer, 0, std::as_writable_bytes(std::span(values)));
        return values;
    }
    void fill(const gpu::Buffer& buffer, std::uint32_t first) {
        std::vector<std::uint32_t> values(buffer.sizeBytes() / 4);
        std::iota(values.begin(), values.end(), first);
        gpu::upload(device(), buffer, 0, std::as_bytes(std::span(values)));
    }
    /// As drivers round sizes up to a page at most.
    static constexpr std::uint64_t kRounded = 7 * 4096;
};

TEST_F(LatticePoolTest, CountsWhatIsAllocated) {
    run();
    const std::uint64_t before = device().allocatedBytes();
    LatticePool pool(device(), 1000, kPayload, 1 << 24);
    const auto expectCounted = [&] {
        const std::uint64_t taken = device().allocatedBytes() - before;
        EXPECT_GE(taken, pool.bytes());
        EXPECT_LE(taken, pool.bytes() + kRounded);
    };
    expectCounted();
    EXPECT_EQ(pool.bytes(), 4000u) << "an index, and nothing else";
    for (std::uint32_t i = 0; i < 5; ++i) {
        std::vector<std::pair<std::uint32_t, std::uint64_t>> wants;
        for (std::uint32_t brick = 150 * i; brick < 150 * i + 300; ++brick) wants.emplace_back(brick, 0xf0fULL << i);
        EXPECT_EQ(admit(pool, wants), 0u);
        expectCounted();
        pool.endRequest();
        expectCounted();
    }
    // 900 bricks; the 600 that were wanted twice have 8 + 2 texels. Pools are at most an eighth larger.
    EXPECT_GE(pool.bytes(), 4000 + 900 * kSlot + 8400 * kRow);
    EXPECT_LE(pool.bytes(), 4000 + 1.125 * (900 * kSlot + 8400 * kRow));
    pool.clear();
    EXPECT_EQ(pool.bytes(), 4000u);
    expectCounted();
    pool.keepWhole(true);
    admit(pool, {{3, 1}, {4, 1}});
    pool.endRequest();
    expectCounted();
    EXPECT_EQ(pool.bytes(), 4000 + 2 * pool.wholeBrickBytes()) << "nothing that says which row is whose";
    EXPECT_EQ(pool.wholeBrickBytes(), kSlot + 64 * (kPayload + 4));
}

TEST_F(LatticePoolTest, TexelsOfABrickStayWhenMoreOfItAreNeeded) {
    LatticePool pool(device(), 20, kPayload, 1 << 20);
    const std::uint64_t first = 0x8000000100000001ULL, second = 0x0000000180000001ULL;
    EXPECT_EQ(admit(pool, {{5, first}, {7, 1}}), 0u);
    EXPECT_EQ(pool.rowsUsed(), 4u);
    EXPECT_EQ(read<std::uint32_t>(pool.state()), std::vector<std::uint32_t>(4, 0)) << "new ones are empty";
    fill(pool.state(), 100);
    fill(pool.payload(), 1000);
    EXPECT_EQ(admit(pool, {{5, second}, {6, first}}), 0u);
    EXPECT_EQ(pool.rowsUsed(), 8u) << "one more of brick 5, three of brick 6";
    const auto states = read<std::uint32_t>(pool.state()), payloads = read<std::uint32_t>(pool.payload());
    std::set<std::uint64_t> rows;
    const std::uint32_t texels[] = {0, 31, 32, 63};
    for (const std::uint32_t brick : {5U, 6U, 7U}) {
        for (const std::uint32_t texel : texels) {
            const auto row = pool.rowOf(brick, texel);
            const std::uint64_t wanted = brick == 5 ? first | second : brick == 6 ? first : 1;
            ASSERT_EQ(row.has_value(), ((wanted >> texel) & 1) != 0) << brick << ", " << texel;
            if (!row) continue;
            EXPECT_TRUE(rows.insert(*row).second) << "a row of two";
            const bool old = *row < 4;
            EXPECT_EQ(old, brick == 7 || (brick == 5 && texel != 31));
            EXPECT_EQ(states.at(*row), old ? 100 + *row : 0);
            for (std::uint64_t i = 0; i < 3; ++i) EXPECT_EQ(payloads.at(3 * *row + i), old ? 1000 + 3 * *row + i : 0);
        }
    }
}

TEST_F(LatticePoolTest, BricksThatWereWantedLongestAgoGiveWayWithTheirRows) {
    // Room for eight bricks of ten texels, and for little more.
    const std::uint64_t ten = 0x3ff, budget = 8 * (kSlot + 10 * kRow) + kRow;
    LatticePool pool(device(), 100, kPayload, budget);
    for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(admit(pool, {{2 * i, ten}, {2 * i + 1, ten}}), 0u);
    fill(pool.state(), 1);
    fill(pool.shown(), 1);
    EXPECT_EQ(admit(pool, {{0, ten}, {50, ten << 20}, {51, ten << 30}}), 0u);
    EXPECT_NE(pool.slotOf(0), 0u) << "wanted again";
    EXPECT_EQ(pool.slotOf(1), 0u) << "oldest";
    EXPECT_EQ(pool.slotOf(2), 0u) << "next";
    for (const std::uint32_t brick : {3U, 4U, 5U, 6U, 7U, 50U, 51U}) EXPECT_NE(pool.slotOf(brick), 0u) << brick;
    const auto states = read<std::uint32_t>(pool.state());
    const auto shown = read<glm::uvec2>(pool.shown());
    for (std::uint32_t texel = 0; texel < 10; ++texel) {
        EXPECT_EQ(states.at(pool.rowOf(50, 20 + texel).value()), 0u) << "nothing of who had the row before";
        const std::uint64_t row = pool.rowOf(7, texel).value();
        EXPECT_EQ(states.at(row), row + 1) << "who stays keeps it";
        EXPECT_EQ(shown.at((pool.slotOf(51) - 1) * 64 + texel), glm::uvec2(0));
    }
    EXPECT_LE(pool.bytes(), budget + 100 * 4 + 100 * 8);
    // One texel more of as many bricks as there is room for: one of them has to wait, and its others stay.
    std::vector<std::pair<std::uint32_t, std::uint64_t>> more;
    for (const std::uint32_t brick : {0U, 3U, 4U, 5U, 6U, 7U}) more.emplace_back(brick, ten);
    more.emplace_back(50, (ten << 20) | 1);
    more.emplace_back(51, (ten << 30) | 1);
    EXPECT_EQ(admit(pool, more), 1u);
    EXPECT_TRUE(pool.rowOf(50, 0));
    EXPECT_FALSE(pool.rowOf(51, 0));
    EXPECT_TRUE(pool.rowOf(51, 30));
    // Another kind of picture: single texels of many bricks, where memory for rows leaves slots for a few of them.
    LatticePool turned(device(), 100, kPayload, 8 * (kSlot + 64 * kRow));
    std::vector<std::pair<std::uint32_t, std::uint64_t>> few, many;
    for (std::uint32_t brick = 0; brick < 100; ++brick) {
        if (brick < 8) few.emplace_back(brick, ~0ULL);
        many.emplace_back(brick, 1ULL << 5);
    }
    EXPECT_EQ(admit(turned, few), 0u);
    const std::uint64_t room = 8 * (kSlot + 64 * kRow) / (kSlot + kRow);
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(admit(turned, many), 100 - room);
        EXPECT_LE(turned.bytes(), 8 * (kSlot + 64 * kRow) + 100 * 4 + 100 * 8);
        EXPECT_TRUE(turned.rowOf(0, 5));
    }
    // What holds no brick with all its texels holds nothing.
    LatticePool tiny(device(), 10, kPayload, kSlot + 63 * kRow);
    EXPECT_EQ(admit(tiny, {{2, 1}}), 1u);
    EXPECT_EQ(tiny.slotsUsed(), 0u);
}

}  // namespace
}  // namespace radiata
