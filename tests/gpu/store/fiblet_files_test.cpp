// Tractograms by way of the cache folder: encoded once, made anew if damaged or changed, from memory if the folder cannot be
// written.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <unistd.h>

#include "io/tractogram.h"
#include "store/fiblet_files.h"
#include "support/random_fibres.h"

namespace radiata::store {
namespace {

using ::testing::HasSubstr;

class FibletFiles : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() / ("radiata_tracts_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
        write(1);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    void write(std::uint32_t seed) {
        const test::Fibres fibres = test::randomFibres(seed, 10 + seed, 100, 0.1, 0.1);
        model::Tractogram tractogram;
        tractogram.header.source = tractogram.header.format = "memory";
        tractogram.fibres.points = fibres.points;
        tractogram.fibres.offsets = fibres.offsets;
        io::writeTractogram(*model::sourceOf(tractogram), tract());
    }
    std::filesystem::path tract() const { return folder_ / "a.tck"; }
    model::FibletSet load(const std::filesystem::path& cache) {
        said_.clear();
        return loadTractogram(tract(), cache, {}, [this](const std::string& line) { said_ += line + "\n"; });
    }

    std::filesystem::path folder_;
    std::string said_;
};

TEST_F(FibletFiles, AreEncodedOnceAndKept) {
    const std::filesystem::path cache = folder_ / "cache" / "deep";
    const model::FibletSet first = load(cache);
    EXPECT_THAT(said_, HasSubstr("encoded in"));
    EXPECT_EQ(first.fibres(), 11U);
    const model::FibletSet second = load(cache);
    EXPECT_THAT(said_, HasSubstr("from the cache"));
    EXPECT_EQ(second.codes, first.codes);
    EXPECT_EQ(second.boxes.size(), first.boxes.size());
    EXPECT_EQ(second.source, "a.tck");

    std::ofstream(cachedFiblets(tract(), cache, {}), std::ios::binary | std::ios::in).seekp(400).put('\x55');
    EXPECT_EQ(load(cache).codes, first.codes);
    EXPECT_THAT(said_, HasSubstr("it is made anew"));
    load(cache);
    EXPECT_THAT(said_, HasSubstr("from the cache"));

    write(2);
    EXPECT_EQ(load(cache).fibres(), 12U);
    EXPECT_THAT(said_, HasSubstr("encoded in"));
    EXPECT_EQ(loadTractogram(cachedFiblets(tract(), cache, {}), {}, {}).fibres(), 12U);
}

TEST_F(FibletFiles, ServeFromMemoryIfTheCacheCannotBeWritten) {
    EXPECT_EQ(load("/proc/no/such/folder").fibres(), 11U);
    EXPECT_THAT(said_, HasSubstr("serves from memory"));
    EXPECT_EQ(load({}).fibres(), 11U);
    EXPECT_TRUE(isTractName("x.fiblet") && isTractName("x.tck") && isTractName("x.tt.gz") && !isTractName("x.nii.gz"));
}

}  // namespace
}  // namespace radiata::store
