// What radiata-phantom writes is read back as the phantom that it was made from.
#include "build/phantom.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "io/sh_image.h"

namespace radiata {
namespace {

TEST(PhantomProgram, ItsFileIsReadBackAsThePhantom) {
    PhantomOptions options;
    options.size = 20;
    options.lmax = 6;
    options.seed = 42;
    const model::ShImage expected = phantomShImage(options);
    for (const char* suffix : {".nii", ".nii.gz"}) {
        const std::filesystem::path path =
            std::filesystem::temp_directory_path() / ("radiata_phantom_" + std::to_string(::getpid()) + suffix);
        const std::string command = RADIATA_PHANTOM " " + path.string() + " --size 20 --lmax 6 --seed 42 >/dev/null";
        ASSERT_EQ(std::system(command.c_str()), 0);
        const model::ShImage read = io::readShImage(path);
        std::filesystem::remove(path);
        EXPECT_EQ(read.size, expected.size);
        EXPECT_EQ(read.layout, expected.layout);
        EXPECT_EQ(read.rejected_voxels, 0U);
        EXPECT_EQ(read.voxels, expected.voxels);
        EXPECT_EQ(read.coefficients, expected.coefficients) << "signs and order change on the way, no values";
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 3; ++row) {
                // Files of NIfTI-1 hold the matrix as float.
                EXPECT_EQ(read.voxel_to_world[column][row], static_cast<float>(expected.voxel_to_world[column][row]));
            }
        }
    }
}

}  // namespace
}  // namespace radiata
