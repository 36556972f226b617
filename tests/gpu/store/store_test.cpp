// The catalogue: ids from file names, looked up in a table and never on disk; broken files beside sound ones; loading that
// holds nobody up.
#include "store/store.h"

#include <chrono>
#include <filesystem>
#include <future>

#include <gmock/gmock.h>

#include "gpu/device/fixture.h"
#include "io/nifti_write.h"
#include "store/glyph_dataset.h"
#include "unit/io/image_bytes.h"

namespace radiata::store {
namespace {

using gpu::errorOf;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class StoreTest : public gpu::DeviceTest {
protected:
    /// A sound SH image with bands 0 and 2 and one glyph in each of its x * 2 * 2 voxels.
    std::filesystem::path writeImage(const std::string& name, int x = 3) const {
        io::Volume volume;
        volume.size = {x, 2, 2, 6};
        volume.voxel_to_world[0][0] = -2;
        volume.voxel_to_world[3] = {5, 6, 7, 1};
        volume.data.assign(static_cast<std::size_t>(x) * 4 * 6, 0.25F);
        std::filesystem::create_directories((folder.path() / name).parent_path());
        io::writeNifti(volume, folder.path() / name);
        return folder.path() / name;
    }

    static std::vector<std::string> ids(const std::vector<CatalogEntry>& entries) {
        std::vector<std::string> result;
        for (const CatalogEntry& entry : entries) result.push_back(entry.id);
        return result;
    }

    test::TempFolder folder;
};

TEST_F(StoreTest, IdsAreMadeFromFileNames) {
    writeImage("data/xa_fod8.nii.gz");
    writeImage("data/Weird Name (2).nii");
    writeImage("data/" + std::string(100, 'q') + ".nii");
    writeImage("data/deeper/hidden.nii");
    folder.write("data/notes.txt", "no image");
    folder.write("data/.nii", "a suffix without a name");
    Store store(device, {});
    EXPECT_THAT(ids(store.add(folder.path() / "data")), ElementsAre("weird_name__2_", std::string(60, 'q'), "xa_fod8"));
    EXPECT_EQ(store.info("xa_fod8").id, "xa_fod8");
}

TEST_F(StoreTest, EqualNamesAreNumbered) {
    writeImage("a/brain.nii", 3);
    writeImage("a/brain.nii.gz", 4);
    writeImage("b/Brain.nii", 5);
    Store store(device, {});
    EXPECT_THAT(ids(store.add(folder.path() / "a")), ElementsAre("brain", "brain-2"));
    EXPECT_THAT(ids(store.add(folder.path() / "b" / "Brain.nii")), ElementsAre("brain-3"));
    EXPECT_EQ(store.info("brain").size.x, 3);
    EXPECT_EQ(store.info("brain-2").size.x, 4);
    EXPECT_EQ(store.info("brain-3").size.x, 5);
}

TEST_F(StoreTest, UnknownAndPathLikeIdsAreNotFound) {
    writeImage("secret.nii");
    writeImage("data/open.nii");
    int reads = 0;
    Store store(device, {}, [&reads](const std::string&) { ++reads; });
    store.add(folder.path() / "data");
    const std::string absolute = (folder.path() / "secret.nii").string();
    for (const std::string& id : {std::string("nobody"), std::string("../secret"), std::string("../secret.nii"), absolute,
                                  std::string("open.nii"), std::string("./open"), std::string("/etc/passwd"), std::string(),
                                  std::string("open\0\n", 6), std::string(1'000'000, 'x')}) {
        for (const auto& ask :
             {std::function<void()>([&] { store.info(id); }), std::function<void()>([&] { store.glyphs(id); })}) {
            const Error error = errorOf(ask);
            EXPECT_EQ(error.code(), Code::kNotFound);
            EXPECT_THAT(error.what(), AllOf(HasSubstr("there is no dataset"), HasSubstr("lists 1 datasets")));
            EXPECT_LT(std::string(error.what()).size(), 150U);
        }
    }
    EXPECT_EQ(reads, 0);
}

TEST_F(StoreTest, WhatIsNoImageIsRefusedWhenAdded) {
    Store store(device, {});
    EXPECT_EQ(errorOf([&] { store.add(folder.path() / "nowhere"); }).code(), Code::kNotFound);
    const Error text = errorOf([&] { store.add(folder.write("notes.txt", "no image")); });
    EXPECT_EQ(text.code(), Code::kUnsupported);
    EXPECT_THAT(text.what(), HasSubstr("notes.txt"));
    EXPECT_TRUE(store.list().empty());
}

TEST_F(StoreTest, ABrokenFileDisturbsNobody) {
    writeImage("good.nii");
    folder.write("broken.nii", "no NIfTI at all");
    folder.write("cut.nii", std::string(400, '\0'));
    Store store(device, {});
    EXPECT_THAT(ids(store.add(folder.path())), ElementsAre("broken", "cut", "good"));
    const std::vector<model::DatasetInfo> list = store.list();
    ASSERT_EQ(list.size(), 3U);
    EXPECT_EQ(list[0].size, glm::ivec3(0));
    EXPECT_EQ(list[1].size, glm::ivec3(0));
    EXPECT_EQ(list[2].size, glm::ivec3(3, 2, 2));
    EXPECT_THAT(errorOf([&] { store.glyphs("broken"); }).what(), HasSubstr("broken.nii"));
    EXPECT_EQ(store.glyphs("good")->info().glyph_count, 12U);
    // Repaired on disk, it is there: a failure is not kept.
    writeImage("broken.nii", 2);
    EXPECT_EQ(store.info("broken").glyph_count, 8U);
}

TEST_F(StoreTest, ListTellsFromHeadersUntilADatasetIsRead) {
    writeImage("one.nii");
    Store store(device, {ShConvention::kDescoteaux07, ShAxes::kVoxel, {}});
    store.add(folder.path());
    const std::uint64_t before = device.allocatedBytes();
    model::DatasetInfo info = store.list().at(0);
    EXPECT_EQ(info.id, "one");
    EXPECT_EQ(info.size, glm::ivec3(3, 2, 2));
    EXPECT_EQ(info.layout, (ShLayout{2, false}));
    EXPECT_EQ(info.voxel_to_world[3], glm::dvec4(5, 6, 7, 1));
    EXPECT_EQ(info.convention, ShConvention::kDescoteaux07);
    EXPECT_EQ(info.axes, ShAxes::kVoxel);
    EXPECT_EQ(info.glyph_count, 0U);
    EXPECT_EQ(info.gpu_bytes, 0U);
    EXPECT_EQ(device.allocatedBytes(), before) << "nothing is loaded by listing";
    const auto first = store.glyphs("one");
    info = store.list().at(0);
    EXPECT_EQ(info.glyph_count, 12U);
    EXPECT_GT(info.gpu_bytes, 0U);
    EXPECT_GT(info.amplitude_max, 0);
    EXPECT_EQ(store.glyphs("one"), first) << "read once";
}

TEST_F(StoreTest, LoadingHoldsNobodyUp) {
    writeImage("slow.nii");
    writeImage("quick.nii");
    Store* seen = nullptr;
    int asked = 0;
    bool others_served = false;
    Store store(device, {}, [&](const std::string&) {
        // Within the reading of one dataset: another one and the list must be there for other threads.
        if (asked++ > 0) return;
        auto other = std::async(std::launch::async, [&] { return seen->list().size() + seen->info("quick").glyph_count; });
        others_served = other.wait_for(std::chrono::seconds(30)) == std::future_status::ready && other.get() == 14;
    });
    seen = &store;
    store.add(folder.path());
    store.glyphs("slow");
    EXPECT_TRUE(others_served);
    EXPECT_EQ(asked, 2);
}

TEST_F(StoreTest, ImagesInMemoryNeedAGoodAndFreeId) {
    model::ShImage image;
    image.size = {1, 1, 1};
    image.layout = {0, false};
    image.voxels = {{0, 0, 0}};
    image.coefficients = {1.0F};
    Store store(device, {});
    store.add("mine", image);
    EXPECT_EQ(store.info("mine").glyph_count, 1U);
    for (const std::string& id :
         {std::string(), std::string("Mine"), std::string("../x"), std::string("a b"), std::string(65, 'a')}) {
        EXPECT_EQ(errorOf([&] { store.add(id, image); }).code(), Code::kInvalidArgument) << id;
    }
    EXPECT_THAT(errorOf([&] { store.add("mine", image); }).what(), HasSubstr("taken"));
    EXPECT_EQ(store.list().size(), 1U);
}

}  // namespace
}  // namespace radiata::store
