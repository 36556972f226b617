// What is written is what is read.
#include "io/nifti_write.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "unit/io/image_bytes.h"

namespace radiata::io {
namespace {

Volume counting(std::array<std::int64_t, 4> size) {
    Volume volume;
    volume.size = size;
    volume.data.resize(static_cast<std::size_t>(size[0] * size[1] * size[2] * size[3]));
    for (std::size_t i = 0; i < volume.data.size(); ++i) volume.data[i] = std::sin(static_cast<float>(i));
    volume.voxel_to_world = glm::dmat4(glm::dvec4(-1.5, 0.25, 0, 0), glm::dvec4(0.5, 2, 0, 0), glm::dvec4(0, 0.125, 2.5, 0),
                                       glm::dvec4(12.5, -3, 7, 1));
    return volume;
}

std::string content(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

TEST(NiftiWrite, RoundTripsPlainAndCompressed) {
    const test::TempFolder folder;
    for (const std::string name : {"a.nii", "a.nii.gz"}) {
        for (const std::int64_t volumes : {1, 6}) {
            const Volume written = counting({5, 4, 3, volumes});
            writeNifti(written, folder.path() / name);
            const Volume read = readVolume(folder.path() / name);
            EXPECT_EQ(read.size, written.size);
            EXPECT_EQ(read.data, written.data);
            EXPECT_EQ(read.voxel_to_world, written.voxel_to_world) << "these numbers fit float32";
        }
    }
}

TEST(NiftiWrite, KeepsNanAndNegativeZero) {
    const test::TempFolder folder;
    Volume volume = counting({4, 1, 1, 1});
    volume.data = {std::nanf(""), -0.0F, 1e-42F, -INFINITY};
    writeNifti(volume, folder.path() / "a.nii");
    const Volume read = readVolume(folder.path() / "a.nii");
    EXPECT_EQ(std::memcmp(read.data.data(), volume.data.data(), 16), 0);
}

TEST(NiftiWrite, LongAxesMakeItNifti2) {
    const test::TempFolder folder;
    const Volume written = counting({40000, 1, 1, 2});
    writeNifti(written, folder.path() / "a.nii");
    const Volume read = readVolume(folder.path() / "a.nii");
    EXPECT_EQ(read.size, written.size);
    EXPECT_EQ(read.data, written.data);
    EXPECT_EQ(content(folder.path() / "a.nii").substr(0, 7), std::string("\x1c\x02\0\0n+2", 7));
}

TEST(NiftiWrite, EqualImagesGiveEqualBytes) {
    const test::TempFolder folder;
    writeNifti(counting({5, 4, 3, 2}), folder.path() / "a.nii.gz");
    writeNifti(counting({5, 4, 3, 2}), folder.path() / "b.nii.gz");
    EXPECT_EQ(content(folder.path() / "a.nii.gz"), content(folder.path() / "b.nii.gz"));
    EXPECT_GT(std::filesystem::file_size(folder.path() / "a.nii.gz"), 100U);
}

TEST(NiftiWrite, RefusesWhatIsNoImage) {
    const test::TempFolder folder;
    Volume volume = counting({5, 4, 3, 2});
    EXPECT_THROW(writeNifti(volume, folder.path() / "a.img"), Error);
    EXPECT_THROW(writeNifti(volume, folder.path() / "missing" / "a.nii"), Error);
    volume.size[2] = 0;
    EXPECT_THROW(writeNifti(volume, folder.path() / "a.nii"), Error);
    volume.size[2] = 4;
    EXPECT_THROW(writeNifti(volume, folder.path() / "a.nii"), Error);
    volume.size[2] = 3;
    volume.voxel_to_world[0] = glm::dvec4(0);
    EXPECT_THROW(writeNifti(volume, folder.path() / "a.nii"), Error);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.nii"));
}

}  // namespace
}  // namespace radiata::io
