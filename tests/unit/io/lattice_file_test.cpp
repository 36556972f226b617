// Saved illumination lattices: what is written is read, and files that lie are refused.
#include "io/lattice_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <unistd.h>

#include <gtest/gtest.h>

#include "base/error.h"

namespace radiata::io {
namespace {

class LatticeFileTest : public testing::Test {
protected:
    std::filesystem::path path_ =
        std::filesystem::temp_directory_path() / ("radiata-lattice-" + std::to_string(::getpid()) + ".lattice");
    const LatticeHeader header_{"lattice of a test", 8, 3};
    ~LatticeFileTest() override { std::filesystem::remove(path_); }

    static LatticePart part(const std::vector<std::uint32_t>& bricks) {
        LatticePart part;
        part.bricks = bricks;
        for (std::size_t i = 0; i < kTexelsPerBrick * bricks.size(); ++i) {
            part.states.push_back(static_cast<std::uint32_t>(i % 7) << 16U);
            for (int byte = 0; byte < 8; ++byte) part.payloads.push_back(static_cast<std::byte>(i * 31 + byte));
        }
        return part;
    }
    void write() {
        LatticeWriter writer(path_, header_);
        writer.write(part({0, 1}));
        writer.write(part({2}));
        writer.finish();
    }
    std::string bytes() const {
        std::ifstream file(path_, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    /// \return whether it was read to its end
    bool reads(const std::string& bytes, std::uint64_t bricks = 3) {
        std::ofstream(path_, std::ios::binary) << bytes;
        try {
            LatticeReader reader(path_);
            while (reader.read(bricks)) continue;
            return true;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(path_.filename().string()), std::string::npos) << error.what();
            return false;
        }
    }
};

TEST_F(LatticeFileTest, GivesBackWhatWasWritten) {
    write();
    LatticeReader reader(path_);
    EXPECT_EQ(reader.header(), header_);
    for (const auto& expected : {part({0, 1}), part({2})}) {
        const auto found = reader.read(3);
        ASSERT_TRUE(found);
        EXPECT_EQ(found->bricks, expected.bricks);
        EXPECT_EQ(found->states, expected.states);
        EXPECT_EQ(found->payloads, expected.payloads);
    }
    EXPECT_FALSE(reader.read(3));
}

TEST_F(LatticeFileTest, RefusesFilesThatLie) {
    write();
    const std::string whole = bytes();
    EXPECT_TRUE(reads(whole));
    EXPECT_FALSE(reads(whole, 2)) << "a brick beyond the lattice";
    // Each byte is covered by a checksum or compared with what it must be, but for the reserved words of two parts.
    int accepted = 0;
    for (std::size_t at = 0; at < whole.size(); at += at < 160 ? 1 : 37) {
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ 0x55);
        accepted += reads(changed);
    }
    EXPECT_LE(accepted, 8);
    for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{40}, whole.size() / 2, whole.size() - 1}) {
        EXPECT_FALSE(reads(whole.substr(0, size))) << size;
    }
}

TEST_F(LatticeFileTest, AppearsOnlyWhenItIsWhole) {
    {
        LatticeWriter writer(path_, header_);
        writer.write(part({0, 1}));
        EXPECT_THROW(writer.finish(), Error) << "a brick is missing";
    }
    EXPECT_FALSE(std::filesystem::exists(path_));
    EXPECT_THROW(LatticeWriter("/nowhere/at/all.lattice", header_), Error);
}

}  // namespace
}  // namespace radiata::io
