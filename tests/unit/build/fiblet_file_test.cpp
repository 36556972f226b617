// Files of fiblets: written and read they are the same, and no truncation, changed bit or contradiction gets through: each is
// refused with an Error, or changes nothing.
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <unistd.h>

#include "base/error.h"
#include "build/fiblet_encode.h"
#include "build/fiblet_pages.h"
#include "io/fiblet_file.h"
#include "io/fiblet_layout.h"
#include "support/random_fibres.h"

namespace radiata {
namespace {

using ::testing::HasSubstr;

class FibletFile : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() / ("radiata_fiblet_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    static std::string contentOf(const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    std::string written(const model::FibletSet& set) {
        io::writeFiblets(set, folder_ / "a.fiblet");
        return contentOf(folder_ / "a.fiblet");
    }
    model::FibletSet read(const std::string& bytes) {
        std::ofstream(folder_ / "b.fiblet", std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
        return io::readFiblets(folder_ / "b.fiblet");
    }
    /// The message of the refusal, or "" if nothing was refused and the content is that of `set`.
    std::string refusal(const std::string& bytes, const std::string& original) {
        try {
            const model::FibletSet set = read(bytes);
            return written(set) == original ? "" : "read as something else";
        } catch (const Error& error) {
            EXPECT_TRUE(error.code() == Code::kCorrupt || error.code() == Code::kUnsupported) << error.what();
            return error.what();
        }
    }

    static model::FibletSet sample(std::size_t fibres) {
        const test::Fibres points = test::randomFibres(21, fibres, 300, 0.1, 0.2);
        model::FibletSet set = encodeFiblets(points.points, points.offsets, {});
        set.fibre_columns = {{"weight", 1, std::vector<float>(set.fibres(), 0.5F)}};
        set.point_columns = {{"fa", 0, std::vector<glm::vec2>(set.heads.size(), glm::vec2(0, 1)),
                              std::vector<std::uint8_t>(64 * set.heads.size(), 7)}};
        set.groups = {{"left", {0, 2}, {{"volume", 2}}, {{1.0F, 2.0F}}}};
        return set;
    }

    std::filesystem::path folder_;
};

TEST_F(FibletFile, ComesBackAsItWas) {
    model::FibletSet set = sample(40);
    set.walked = true;
    set.walk_errors = {1, 2, 3};
    const std::string bytes = written(set);
    model::FibletSet back = io::readFiblets(folder_ / "a.fiblet");
    EXPECT_EQ(back.source, "a.fiblet");
    EXPECT_EQ(back.points, set.points);
    EXPECT_EQ(back.errors.max_um, set.errors.max_um);
    EXPECT_EQ(back.walk_errors.points, 3U);
    EXPECT_EQ(back.codes, set.codes);
    EXPECT_EQ(back.groups[0].fibres, set.groups[0].fibres);
    EXPECT_EQ(back.groups[0].values, set.groups[0].values);
    EXPECT_EQ(written(back), bytes);
    boundFiblets(back);
    ASSERT_EQ(back.boxes.size(), set.boxes.size());
    for (std::size_t i = 0; i < set.boxes.size(); ++i) {
        EXPECT_EQ(back.boxes[i].low, set.boxes[i].low);
        EXPECT_EQ(back.boxes[i].high, set.boxes[i].high);
    }
    const model::FibletSet head = io::readFibletHeader(folder_ / "a.fiblet");
    EXPECT_EQ(head.points, set.points);
    EXPECT_EQ(head.errors.mean_um, set.errors.mean_um);

    const model::FibletSet nothing = encodeFiblets(std::vector<glm::vec3>{}, std::vector<std::uint64_t>{0}, {});
    EXPECT_EQ(written(nothing), (written(read(written(nothing)))));
}

TEST_F(FibletFile, RefusesEveryTruncationAndEveryChangedByte) {
    const std::string bytes = written(sample(4));
    for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 40) {
        EXPECT_NE(refusal(bytes.substr(0, size), bytes), "") << "cut to " << size;
    }
    EXPECT_THAT(refusal(bytes.substr(0, bytes.size() - 1), bytes), HasSubstr("cut off"));
    EXPECT_THAT(refusal(bytes + "x", bytes), HasSubstr("damaged"));
    std::mt19937 random(22);
    std::size_t harmless = 0;
    for (std::size_t i = 0; i < bytes.size(); i += i < 600 ? 2 : 37) {
        std::string damaged = bytes;
        damaged[i] = char(damaged[i] ^ (1 << random() % 8));
        const std::string said = refusal(damaged, bytes);
        EXPECT_NE(said, "read as something else") << "byte " << i;
        harmless += said.empty();
    }
    EXPECT_LT(harmless, 600U);  // in the filling between sections
}

TEST_F(FibletFile, RefusesContradictionsUnderRightChecksums) {
    const auto message = [&](auto change) {
        model::FibletSet set = sample(40);
        change(set);
        std::string bytes;
        try {
            bytes = written(set);
            io::readFiblets(folder_ / "a.fiblet");
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), Code::kCorrupt) << error.what();
            return std::string(error.what());
        }
        return std::string("nothing refused");
    };
    EXPECT_THAT(message([](auto& set) { set.heads[3].fibre = 40; }), HasSubstr("is of fibre 40 of 40"));
    EXPECT_THAT(message([](auto& set) { set.heads[3].shape ^= 1U << 20; }), HasSubstr("the index says otherwise"));
    EXPECT_THAT(message([](auto& set) { set.heads[3].shape ^= 1U << 8; }), HasSubstr("flags or length"));
    EXPECT_THAT(message([](auto& set) { set.heads[63].shape |= 1023U << 10; }), HasSubstr("end behind its page's"));
    EXPECT_THAT(message([](auto& set) { std::swap(set.fibre_fiblets[0], set.fibre_fiblets[1]); }),
                HasSubstr("the index says otherwise"));
    EXPECT_THAT(message([](auto& set) { set.fibre_first[2] = 1000; }), HasSubstr("fibre"));
    EXPECT_THAT(message([](auto& set) { set.pages[0].count = 63; }), HasSubstr("page 0 says 63 fiblets"));
    EXPECT_THAT(message([](auto& set) { set.codec.cap_ratio[4] = 2.5F; }), HasSubstr("ratio 2.5"));
    EXPECT_THAT(message([](auto& set) { set.codec.step_mm = NAN; }), HasSubstr("steps"));
    EXPECT_THAT(message([](auto& set) { set.groups[0].fibres = {0, 40}; }), HasSubstr("lists fibre 40 of 40"));
}

TEST_F(FibletFile, NamesWhatIsWrongWithTheFile) {
    const std::string bytes = written(sample(4));
    std::string other = bytes;
    other[8] = 2;
    EXPECT_THAT(refusal(other, bytes), HasSubstr("version 2"));
    EXPECT_THAT(refusal("mrtrix tracks" + bytes, bytes), HasSubstr("does not begin as a .fiblet file"));
    EXPECT_THROW(io::readFiblets(folder_ / "missing.fiblet"), Error);
    EXPECT_THROW(io::writeFiblets(sample(4), folder_ / "missing" / "a.fiblet"), Error);
    EXPECT_THROW(io::writeFiblets(sample(4), "/dev/full/a.fiblet"), Error);
}

}  // namespace
}  // namespace radiata
