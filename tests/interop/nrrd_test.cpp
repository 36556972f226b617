// NRRD files that teem's unu writes hold the numbers that it was given, attached and detached, plain and compressed, and the
// geometry.
#include <gtest/gtest.h>

#include <fstream>

#include "interop/programs.h"
#include "io/scalar_image.h"
#include "unit/io/image_bytes.h"

namespace radiata {
namespace {

TEST(Teem, VolumesThatUnuWroteAreRead) {
    test::requireTeem();
    const test::TempFolder folder;
    const std::string dir = folder.path().string() + "/";
    // 2 x 3 x 2 numbers as text, with a frame in LPS.
    folder.write("text.nhdr",
                 "NRRD0004\ndimension: 3\nsizes: 2 3 2\ntype: float\nencoding: text\nspace: left-posterior-superior\n"
                 "space directions: (2,0,0) (0,0,-3) (0,1.5,0)\nspace origin: (1,2,3)\ndata file: text.txt\n\n");
    folder.write("text.txt", "0 1\n2 3\n4 5\n6 7\n8 9\n10 -11\n");
    const std::vector<float> expected{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, -11};
    for (const std::string type : {"int8", "short", "int", "longlong", "float", "double"}) {
        for (const std::string encoding : {"raw", "gzip"}) {
            for (const std::string name : {"v.nrrd", "v.nhdr"}) {
                for (const std::string endian : {"little", "big"}) {
                    test::run("teem-unu convert -t " + type + " -i " + dir + "text.nhdr | teem-unu save -f nrrd -e " +
                              encoding + " -en " + endian + " -o " + dir + name);
                    const model::ScalarImage image = io::readScalarImage(dir + name);
                    EXPECT_EQ(image.values, expected) << type << encoding << name << endian;
                    EXPECT_EQ(image.size, glm::ivec3(2, 3, 2));
                    EXPECT_EQ(image.voxel_to_world[1], glm::dvec4(0, 0, -3, 0));
                    EXPECT_EQ(image.voxel_to_world[2], glm::dvec4(0, -1.5, 0, 0));
                    EXPECT_EQ(image.voxel_to_world[3], glm::dvec4(-1, -2, 3, 1));
                }
            }
        }
    }
}

}  // namespace
}  // namespace radiata
