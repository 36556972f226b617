// Conversion in bounded memory: any number of runs gives the bytes of one, a conversion that was killed goes on where it was,
// and what changed is begun anew.
#include "ingest/fiblet_conversion.h"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "io/fiblet_file.h"
#include "support/random_fibres.h"

namespace radiata {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class FibletConversion : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("radiata_conversion_" + std::to_string(::getpid()));
        fs::create_directories(folder_);
        const test::Fibres fibres = test::randomFibres(31, 300, 400, 0.2, 0.2);
        tracts_.header.source = "random";
        tracts_.header.fibre_columns = {{"weight", 1}, {"end", 3}};
        tracts_.header.vertex_columns = {{"fa", 1}, {"v", 2}};
        tracts_.fibres.clear(2, 2);
        tracts_.fibres.points = fibres.points;
        tracts_.fibres.offsets = fibres.offsets;
        // Fibres without points, the last one among them.
        tracts_.fibres.offsets.insert(tracts_.fibres.offsets.begin() + 40, tracts_.fibres.offsets[40]);
        tracts_.fibres.offsets.push_back(tracts_.fibres.offsets.back());
        const std::size_t points = fibres.points.size(), count = tracts_.fibres.fibreCount();
        for (std::size_t i = 0; i < 3 * points; ++i) {
            if (i < points) tracts_.fibres.vertex_values[0].push_back(float(i % 1000));
            if (i < 2 * points) tracts_.fibres.vertex_values[1].push_back(float(i % 77) - 30);
        }
        for (std::size_t i = 0; i < 3 * count; ++i) {
            if (i < count) tracts_.fibres.fibre_values[0].push_back(float(i));
            tracts_.fibres.fibre_values[1].push_back(float(i) / 3);
        }
        tracts_.groups = {{"left", {0, 3, 200}, {{"n", 1}}, {{7.5F}}}};
    }
    void TearDown() override { fs::remove_all(folder_); }

    static std::string contentOf(const fs::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    /// What the encoder in memory gives.
    std::string whole() {
        io::writeFiblets(encodeFiblets(tracts_, {}), folder_ / "whole.fiblet");
        return contentOf(folder_ / "whole.fiblet");
    }
    ingest::Conversion convert(std::uint64_t memory_bytes, const std::string& state = "a", const FibletProgress& progress = {},
                               const FibletOptions& fiblets = {}) {
        said_.clear();
        return ingest::convertToFiblets([&] { return model::sourceOf(tracts_); }, state, target_,
                                        {.fiblets = fiblets, .memory_bytes = memory_bytes}, progress,
                                        [&](const std::string& sentence) { said_ += sentence; });
    }
    /// A conversion in another process that is killed when so much is done; the memory makes runs of about 24 fibres.
    void killAt(double share) {
        const pid_t child = ::fork();
        if (child == 0) {
            convert(kLittle, "a", [share](double done) {
                if (done >= share) ::raise(SIGKILL);
            });
            ::_exit(1);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    }

    static constexpr std::uint64_t kLittle = 100'000;
    model::Tractogram tracts_;
    fs::path folder_, target_;
    std::string said_;
};

TEST_F(FibletConversion, GivesTheSameBytesInAnyMemory) {
    const std::string expected = whole();
    for (const std::uint64_t memory : {std::uint64_t{1}, std::uint64_t{20'000}, kLittle, std::uint64_t{1} << 30}) {
        target_ = folder_ / ("a" + std::to_string(memory) + ".fiblet");
        const ingest::Conversion done = convert(memory);
        EXPECT_EQ(done.fibres, 302U);
        EXPECT_EQ(done.continued, 0U);
        const std::string content = contentOf(target_);
        EXPECT_EQ(content.size(), expected.size());
        EXPECT_EQ(std::ranges::mismatch(content, expected).in1 - content.begin(), std::ptrdiff_t(expected.size())) << memory;
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 5) << "nothing is left beside the files";
    tracts_ = {};
    tracts_.header.source = "nothing";
    target_ = folder_ / "nothing.fiblet";
    convert(kLittle);
    EXPECT_TRUE(contentOf(target_) == whole());
}

TEST_F(FibletConversion, GoesOnWhereItWasKilled) {
    const std::string expected = whole();
    for (const double share : {0.1, 0.5, 0.7, 0.95}) {
        target_ = folder_ / "a.fiblet";
        fs::remove(target_);
        killAt(share);
        ASSERT_TRUE(fs::exists(folder_ / "a.fiblet.runs") || share < 0.2);
        EXPECT_FALSE(fs::exists(target_));
        const ingest::Conversion done = convert(1 << 20);  // runs of another size
        EXPECT_EQ(done.continued > 0, share > 0.2) << share;
        if (done.continued > 0) {
            EXPECT_THAT(said_, HasSubstr("a.fiblet.runs, where " + std::to_string(done.continued) + " fibres are encoded"));
        }
        EXPECT_TRUE(contentOf(target_) == expected) << share;
        EXPECT_FALSE(fs::exists(folder_ / "a.fiblet.runs"));
    }
}

TEST_F(FibletConversion, BeginsAnewWhenInputOrSettingsChangedOrTheScratchFileIsDamaged) {
    const std::string expected = whole();
    target_ = folder_ / "a.fiblet";
    killAt(0.6);
    EXPECT_EQ(convert(kLittle, "b").continued, 0U);
    killAt(0.6);
    EXPECT_EQ(convert(kLittle, "a", {}, {.bound_um = 20}).continued, 0U);
    // A run that was changed and all after it are encoded again.
    killAt(0.6);
    const fs::path scratch = folder_ / "a.fiblet.runs";
    std::string bytes = contentOf(scratch);
    bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 8);
    std::ofstream(scratch, std::ios::binary) << bytes;
    const std::uint64_t sound = convert(kLittle).continued;
    EXPECT_GT(sound, 0U);
    EXPECT_TRUE(contentOf(target_) == expected);
    killAt(0.6);
    EXPECT_GT(convert(kLittle).continued, sound);
    std::ofstream(scratch, std::ios::binary) << "something else";
    EXPECT_EQ(convert(kLittle).continued, 0U);
    EXPECT_TRUE(contentOf(target_) == expected);
}

TEST_F(FibletConversion, KnowsAFileAgainByItsSizeTimeAndBeginning) {
    const fs::path file = folder_ / "a.tck";
    std::ofstream(file) << "tracks";
    const std::string before = ingest::stateOf({file});
    EXPECT_EQ(ingest::stateOf({file}), before);
    const auto time = fs::last_write_time(file);
    std::ofstream(file) << "trucks";
    fs::last_write_time(file, time);
    EXPECT_NE(ingest::stateOf({file}), before);
    std::ofstream(file) << "tracks";
    fs::last_write_time(file, time + std::chrono::seconds(1));
    EXPECT_NE(ingest::stateOf({file}), before);
    fs::create_directory(folder_ / "t.trx");
    const std::string empty = ingest::stateOf({folder_ / "t.trx"});
    std::ofstream(folder_ / "t.trx" / "positions.float32") << "x";
    EXPECT_NE(ingest::stateOf({folder_ / "t.trx"}), empty);
}

/// A disk with room for some runs only: a sentence, and the next attempt goes on.
TEST_F(FibletConversion, KeepsCompleteRunsWhenTheDiskIsFull) {
    const std::string expected = whole();
    target_ = folder_ / "a.fiblet";
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit little = before;
    little.rlim_cur = 200'000;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
    std::string said;
    try {
        convert(kLittle);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), Code::kUnavailable);
        said = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_THAT(said, HasSubstr("a.fiblet.runs: cannot be written"));
    EXPECT_THAT(said, HasSubstr("encoded fibres are kept"));
    EXPECT_FALSE(fs::exists(target_));
    EXPECT_FALSE(fs::exists(folder_ / "a.fiblet.part"));
    EXPECT_GT(convert(kLittle).continued, 0U);
    EXPECT_TRUE(contentOf(target_) == expected);
}

}  // namespace
}  // namespace radiata
