// Tractograms of the catalogue: listed from their headers, encoded on first use, kept in a cache, selected and handed out
// again.
#include "store/tract_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "base/error.h"
#include "build/fibre_selection.h"
#include "gpu/device/fixture.h"
#include "io/tractogram.h"
#include "model/selection_text.h"
#include "store/dataset_infos.h"
#include "store/store.h"
#include "support/random_fibres.h"
#include "unit/io/image_bytes.h"
#include "unit/io/tract_bytes.h"

namespace radiata::store {
namespace {

namespace fs = std::filesystem;

/// 60 random fibres with a column of each kind and a group.
model::Tractogram tracts() {
    const test::Fibres fibres = test::randomFibres(4, 60, 300, 0.2, 0.2);
    model::Tractogram all;
    all.header.source = "random";
    all.header.fibre_columns = {{"weight", 1}};
    all.header.vertex_columns = {{"fa", 1}};
    all.fibres.clear(1, 1);
    all.fibres.points = fibres.points;
    all.fibres.offsets = fibres.offsets;
    all.fibres.vertex_values[0].assign(fibres.points.size(), 0.5F);
    for (std::size_t f = 0; f < 60; ++f) all.fibres.fibre_values[0].push_back(static_cast<float>(f));
    all.groups.push_back({"few", {2, 3}, {}, {}});
    return all;
}

std::size_t filesIn(const fs::path& folder) {
    return fs::exists(folder) ? static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {})) : 0;
}

TEST(TractFiles, AreEncodedOnceAndReadFromTheCacheAfterwards) {
    const test::TempFolder folder;
    const fs::path file = folder.path() / "a.trx", cache = folder.path() / "cache" / "fiblets";
    io::writeTractogram(*model::sourceOf(tracts()), file);
    std::vector<std::string> said;
    const auto log = [&](const std::string& sentence) { said.push_back(sentence); };
    const model::FibletSet first = loadTracts(file, {cache}, log);
    EXPECT_EQ(filesIn(cache), 1U);
    const model::FibletSet second = loadTracts(file, {cache}, log);
    ASSERT_EQ(said.size(), 2U);
    EXPECT_THAT(said[0], testing::StartsWith("a.trx: 60 fibres, "));
    EXPECT_THAT(said[1], testing::EndsWith("from the cache"));
    EXPECT_EQ(first.codes, second.codes);
    EXPECT_EQ(second.fibre_columns.at(0).values.size(), 60U);
    EXPECT_EQ(second.groups.at(0).fibres, (std::vector<std::uint32_t>{2, 3}));
    EXPECT_EQ(first.boxes.size(), second.boxes.size());
    // Another content is another entry; a damaged entry is made anew.
    model::Tractogram more = tracts();
    more.fibres.points[0].x += 1;
    io::writeTractogram(*model::sourceOf(more), file);
    fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(2));
    loadTracts(file, {cache}, log);
    EXPECT_EQ(filesIn(cache), 2U);
    for (const auto& entry : fs::directory_iterator(cache)) fs::resize_file(entry.path(), 100);
    said.clear();
    EXPECT_EQ(loadTracts(file, {cache}, log).fibres(), 60U);
    ASSERT_EQ(said.size(), 2U);
    EXPECT_THAT(said[0], testing::EndsWith("it is made anew"));
}

TEST(TractFiles, AreServedFromMemoryWhenTheCacheCannotBeWritten) {
    const test::TempFolder folder;
    const fs::path file = folder.path() / "a.tck";
    io::writeTractogram(*model::sourceOf(tracts()), file);
    std::string said;
    const auto log = [&](const std::string& sentence) { said += sentence + "\n"; };
    // A device that is always full, and a file where the folder should be.
    const fs::path full = folder.path() / "full";
    std::ofstream(full) << "no folder";
    EXPECT_EQ(loadTracts(file, {full / "fiblets"}, log).fibres(), 60U);
    EXPECT_THAT(said, testing::HasSubstr("served from memory, nothing is kept for the next start"));
    EXPECT_EQ(loadTracts(file, {}, log).fibres(), 60U);
}

TEST(TractFiles, TakeTheColumnsThatLieBesideThemAndSayWhichDoNotFit) {
    const test::TempFolder folder;
    const fs::path file = folder.path() / "a.tck";
    io::writeTractogram(*model::sourceOf(tracts()), file);  // a_fa.tsf and a_weight.txt, too
    folder.write("a_other.txt", "1 2 3\n");
    folder.write("b_weight.txt", "1 2 3\n");
    std::string said;
    const model::FibletSet set = loadTracts(file, {}, [&](const std::string& sentence) { said += sentence + "\n"; });
    ASSERT_EQ(set.fibre_columns.size(), 1U);
    EXPECT_EQ(set.fibre_columns[0].name, "weight");
    ASSERT_EQ(set.point_columns.size(), 1U);
    EXPECT_EQ(set.point_columns[0].name, "fa");
    EXPECT_THAT(said, testing::HasSubstr("a_other.txt: holds values of 3 fibres"));
    EXPECT_THAT(said, testing::HasSubstr("the column is left out"));
}

/// A disk that takes no more than a kilobyte: the fibres are served, nothing half is left, and somebody is told.
TEST(TractFiles, AreServedFromMemoryWhenTheDiskIsFull) {
    const test::TempFolder folder;
    const fs::path file = folder.path() / "a.trx", cache = folder.path() / "cache";
    io::writeTractogram(*model::sourceOf(tracts()), file);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit little = before;
    little.rlim_cur = 1024;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
    std::string said;
    const model::FibletSet set = loadTracts(file, {cache}, [&](const std::string& sentence) { said += sentence + "\n"; });
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(set.fibres(), 60U);
    EXPECT_THAT(said, testing::HasSubstr("served from memory"));
    EXPECT_TRUE(fs::is_empty(cache));
    EXPECT_EQ(loadTracts(file, {cache}, {}).fibres(), 60U);
    EXPECT_FALSE(fs::is_empty(cache)) << "once there is room again it is kept";
}

/// What was assumed about a file and left out of it is said when it is read, and again when it comes from the cache.
TEST(TractFiles, SayWhatWasAssumedAndLeftOut) {
    const test::TempFolder folder;
    std::vector<double> numbers = {1, 2, 3, 1.2, 2, 3, test::kNanNumber, test::kNanNumber, test::kNanNumber};
    // One fibre at 1000 m, and one 90 m from the others.
    for (const double far : {1e6, 9e4})
        numbers.insert(numbers.end(), {1, 2, 3, far, 2, 3, test::kNanNumber, test::kNanNumber, test::kNanNumber});
    for (int i = 0; i < 3; ++i) numbers.push_back(test::kInfNumber);
    folder.write("odd.tck", test::tckBytes({"mrtrix tracks", "file: . 200"}, numbers));
    const fs::path cache = folder.path() / "cache";
    for (const char* from : {"read", "cache"}) {
        std::string said;
        const model::FibletSet set =
            loadTracts(folder.path() / "odd.tck", {cache}, [&](const std::string& sentence) { said += sentence + "\n"; });
        EXPECT_EQ(set.fibres(), 3U);
        EXPECT_EQ(set.heads.size(), 1U) << "two are left out";
        EXPECT_THAT(said, testing::HasSubstr("odd.tck: The header names no datatype; Float32LE is assumed. 1 fibre reaches "
                                             "farther than "))
            << from;
        EXPECT_THAT(said, testing::HasSubstr("1 fibre is left out, but keeps its number: it has coordinates")) << from;
        EXPECT_EQ(fibletInfo("odd", set).remarks, set.remarks);
    }
}

TEST(TractFiles, AreNotBelievedMoreFibresThanTheyHaveRoomFor) {
    const test::TempFolder folder;
    folder.write("lies.tck", test::tckBytes(test::tckLines("Float32LE", "1000000000000000"), test::twoTracks()));
    folder.write("says.tck", test::tckBytes(test::tckLines("Float32LE", "2"), test::twoTracks()));
    EXPECT_EQ(tractHeaderInfo("a", folder.path() / "lies.tck").fibres, 0U);
    EXPECT_EQ(tractHeaderInfo("a", folder.path() / "says.tck").fibres, 2U);
}

class TractStore : public gpu::DeviceTest {};

TEST_F(TractStore, TurnsVtkAxesOnRequest) {
    const test::TempFolder folder;
    folder.write("lines.vtk", test::vtkText());
    Store store(device, {});
    store.setTractCache(folder.path() / "cache");
    store.add(folder.path() / "lines.vtk");
    Store turned(device, {});
    turned.setTractCache(folder.path() / "cache");
    turned.setVtkSpace(io::VtkSpace::kLps);
    turned.add(folder.path() / "lines.vtk");
    EXPECT_THAT(store.info("lines").remarks, testing::HasSubstr("RAS is assumed, --vtk-space lps"));
    EXPECT_EQ(turned.info("lines").remarks, "");
    EXPECT_NEAR(turned.info("lines").bounds_min.x, -store.info("lines").bounds_max.x, 0.02);
    EXPECT_NEAR(turned.info("lines").bounds_min.z, store.info("lines").bounds_min.z, 0.02);
    const glm::vec3 first = model::readAll(*store.tracts("lines")).fibres.points[0];
    EXPECT_EQ(model::readAll(*turned.tracts("lines")).fibres.points[0], glm::vec3(-first.x, -first.y, first.z));
}

TEST_F(TractStore, ListsTractogramsSelectsAndHandsThemOut) {
    const test::TempFolder folder;
    const model::Tractogram all = tracts();
    io::writeTractogram(*model::sourceOf(all), folder.path() / "Zip.trx");
    io::writeTractogram(*model::sourceOf(all), folder.path() / "open.trx" / "");
    io::writeTractogram(*model::sourceOf(all), folder.path() / "lines.tck");
    Store store(device, {});
    EXPECT_EQ(store.add(folder.path()).size(), 3U);
    const std::vector<model::DatasetInfo> infos = store.list();
    ASSERT_EQ(infos.size(), 3U);
    for (const model::DatasetInfo& info : infos) {
        EXPECT_EQ(info.kind, model::DatasetKind::kTractogram);
        EXPECT_EQ(info.fibres, 60U);
    }
    EXPECT_EQ(infos[0].id, "lines");
    EXPECT_EQ(infos[2].id, "zip");
    const model::DatasetInfo info = store.info("zip");
    EXPECT_EQ(info.points, all.fibres.points.size());
    EXPECT_EQ(store.selector("zip")->select(model::parseSelection("group(few) or fibres(7)")).count(), 3U);
    EXPECT_EQ(model::readAll(*store.tracts("open")).fibres.points, all.fibres.points);
    EXPECT_THROW(store.glyphs("zip"), Error);
    // A volume of the catalogue is a mask.
    model::ScalarImage mask;
    mask.size = {1, 1, 1};
    mask.voxel_to_world = glm::dmat4(1000.0);
    mask.voxel_to_world[3] = {0, 0, 0, 1};
    mask.values = {1};
    store.add("everywhere", std::move(mask));
    EXPECT_EQ(store.selector("zip")->select(model::parseSelection("all mask(everywhere)")).count(), 60U);
    try {
        store.selector("zip")->select(model::parseSelection("mask(zip)"));
        ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "dataset 'zip' is a tractogram; a mask is a scalar volume");
    }
}

}  // namespace
}  // namespace radiata::store
