// Scalar volumes: their kind is told from the file, and they colour only glyphs on their own grid, however it is stored.
#include "store/scalar_dataset.h"

#include <limits>

#include <gmock/gmock.h>

#include "gpu/device/fixture.h"
#include "io/nifti_write.h"
#include "store/glyph_dataset.h"
#include "store/store.h"
#include "unit/io/image_bytes.h"

namespace radiata::store {
namespace {

using gpu::errorOf;
using ::testing::AllOf;
using ::testing::HasSubstr;

using ScalarStoreTest = gpu::DeviceTest;

io::Volume volume(int volumes) {
    io::Volume made;
    made.size = {4, 3, 2, volumes};
    made.voxel_to_world = glm::dmat4(2.0);
    made.voxel_to_world[3] = {5, 6, 7, 1};
    for (std::int64_t i = 0; i < 24 * volumes; ++i) made.data.push_back(static_cast<float>(i) - 3.5F);
    return made;
}

TEST_F(ScalarStoreTest, KindFollowsTheNumberOfVolumes) {
    const test::TempFolder folder;
    io::writeNifti(volume(1), folder.path() / "fa.nii.gz");
    io::writeNifti(volume(6), folder.path() / "fod.nii.gz");
    Store store(device, {});
    store.add(folder.path());
    const std::uint64_t before = device.allocatedBytes();
    for (int round = 0; round < 2; ++round) {  // from headers, then from what is loaded
        const std::vector<model::DatasetInfo> list = store.list();
        ASSERT_EQ(list.size(), 2U);
        EXPECT_EQ(list[0].kind, model::DatasetKind::kScalarVolume);
        EXPECT_EQ(list[0].size, glm::ivec3(4, 3, 2));
        EXPECT_EQ(list[1].kind, model::DatasetKind::kShImage);
        EXPECT_EQ(list[0].value_max, round == 0 ? 0 : 19.5F);
        EXPECT_EQ(store.info("fa").value_min, -3.5F);
    }
    EXPECT_EQ(device.allocatedBytes(), before) << "a volume takes no memory of the device until a layer shows it";
    EXPECT_EQ(store.scalars("fa")->image().at({3, 2, 1}), 19.5F);
    const Error no_glyphs = errorOf([&] { store.glyphs("fa"); });
    EXPECT_EQ(no_glyphs.code(), Code::kInvalidArgument);
    EXPECT_THAT(no_glyphs.what(), AllOf(HasSubstr("'fa'"), HasSubstr("scalar volume")));
    const Error no_scalars = errorOf([&] { store.scalars("fod"); });
    EXPECT_EQ(no_scalars.code(), Code::kInvalidArgument);
    EXPECT_THAT(no_scalars.what(), AllOf(HasSubstr("'fod'"), HasSubstr("SH image")));
}

model::ScalarImage scalars(const glm::ivec3& size, const glm::dmat4& voxel_to_world) {
    model::ScalarImage image{size, voxel_to_world, {}, "test"};
    image.values.resize(static_cast<std::size_t>(size.x * size.y * size.z), 1.0F);
    return image;
}

TEST(ScalarDataset, RangeLeavesOutWhatIsNotFinite) {
    model::ScalarImage image = scalars({2, 2, 1}, glm::dmat4(1.0));
    image.values = {std::numeric_limits<float>::quiet_NaN(), -2, std::numeric_limits<float>::infinity(), 3};
    const ScalarDataset dataset("any", image);
    EXPECT_EQ(dataset.info().value_min, -2);
    EXPECT_EQ(dataset.info().value_max, 3);
    image.values.assign(4, std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(ScalarDataset("any", image).info().value_max, 0);
}

TEST(ScalarDataset, GridMayBeStoredInAnotherOrderButNotElsewhere) {
    model::DatasetInfo glyphs;
    glyphs.id = "fod";
    glyphs.size = {4, 3, 2};
    glyphs.voxel_to_world = {{1.2, 0.3, 0, 0}, {-0.3, 1.2, 0, 0}, {0, 0, 2, 0}, {5, 6, 7, 1}};
    const glm::dmat4& m = glyphs.voxel_to_world;
    EXPECT_LT(glm::length(voxelMap(ScalarDataset("fa", scalars({4, 3, 2}, m)), glyphs)[3] - glm::dvec4(0, 0, 0, 1)), 1e-12);
    // First axis reversed, and the second and third exchanged.
    const glm::dmat4 stored(-m[0], m[2], m[1], m[3] + 3.0 * m[0]);
    const glm::dmat4 map = voxelMap(ScalarDataset("fa", scalars({4, 2, 3}, stored)), glyphs);
    EXPECT_LT(glm::length(glm::dvec3(map * glm::dvec4(1, 2, 0, 1)) - glm::dvec3(2, 0, 2)), 1e-9);

    glm::dmat4 shifted = m;
    shifted[3] += 0.02 * m[0];
    glm::dmat4 stretched = m;
    stretched[2] *= 1.02;
    const std::pair<model::ScalarImage, const char*> bad[] = {
        {scalars({4, 3, 3}, m), "4 x 3 x 3"},
        {scalars({4, 3, 2}, shifted), "0.02 voxels"},
        {scalars({4, 3, 2}, stretched), "0.0196 voxels"},
        {scalars({4, 3, 2}, glm::dmat4(m[0], m[1], m[2], m[3] + m[0])), "1 voxels"},
        {scalars({4, 2, 3}, m), "lie at different places"},
    };
    for (const auto& [image, text] : bad) {
        const ScalarDataset dataset("fa", image);
        const Error error = errorOf([&, &d = dataset] { voxelMap(d, glyphs); });
        EXPECT_EQ(error.code(), Code::kInvalidArgument);
        EXPECT_THAT(error.what(), AllOf(HasSubstr("'fa'"), HasSubstr("'fod'"), HasSubstr(text)));
    }
}

}  // namespace
}  // namespace radiata::store
