// Radiance pictures: values, orientation, and files that lie.
#include "io/environment_map.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <unistd.h>

#include <gtest/gtest.h>

#include "base/error.h"

namespace radiata::io {
namespace {

class EnvironmentMapTest : public testing::Test {
protected:
    std::filesystem::path path_ =
        std::filesystem::temp_directory_path() / ("radiata-environment-" + std::to_string(::getpid()) + ".hdr");
    ~EnvironmentMapTest() override { std::filesystem::remove(path_); }

    model::EnvironmentMap readBytes(const std::string& bytes) {
        std::ofstream(path_, std::ios::binary) << bytes;
        return readEnvironmentMap(path_);
    }
    static std::string header(int width, int height) {
        return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
    }
};

TEST_F(EnvironmentMapTest, ReadsPixelsFromTheTopLeft) {
    // Mantissas are 8 bits, times 2^(exponent - 136): (128, 64, 32, 129) is (1, 0.5, 0.25).
    const std::string one("\x80\x40\x20\x81", 4), dark("\0\0\0\0", 4), bright("\x80\x80\x80\x8b", 4);
    const model::EnvironmentMap map = readBytes(header(4, 2) + one + dark + dark + dark + dark + dark + dark + bright);
    ASSERT_EQ(map.width, 4);
    ASSERT_EQ(map.height, 2);
    EXPECT_EQ(map.pixels[0], glm::vec3(1, 0.5F, 0.25F));
    EXPECT_EQ(map.pixels[1], glm::vec3(0));
    EXPECT_EQ(map.pixels[7], glm::vec3(1024)) << "far above 1";
}

TEST_F(EnvironmentMapTest, DividesByAllExposures) {
    const std::string one("\x80\x40\x20\x81", 4), row = one + one;
    const auto read = [&](const std::string& lines) {
        return readBytes("#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + row).pixels[1];
    };
    EXPECT_EQ(read(""), glm::vec3(1, 0.5F, 0.25F));
    EXPECT_EQ(read("EXPOSURE=2\n"), glm::vec3(0.5F, 0.25F, 0.125F));
    EXPECT_EQ(read("EXPOSURE= 4.0\r\nVIEW= -vtv\nEXPOSURE=+0.125\n"), glm::vec3(2, 1, 0.5F)) << "several multiply";
    EXPECT_EQ(read("# EXPOSURE=2\n"), glm::vec3(1, 0.5F, 0.25F)) << "a comment";
    for (const char* wrong : {"-1", "0", "nan", "inf", "bright", "", "1e40\nEXPOSURE=1e40"}) {
        EXPECT_THROW(read("EXPOSURE=" + std::string(wrong) + "\n"), Error) << wrong;
    }
}

TEST_F(EnvironmentMapTest, RefusesFilesThatLie) {
    const std::string pixel("\x80\x40\x20\x81", 4);
    EXPECT_THROW(readBytes("P6 4 2 255 " + std::string(24, 'x')), Error) << "another format";
    EXPECT_THROW(readBytes(header(4, 2) + pixel), Error) << "cut short";
    EXPECT_THROW(readBytes(header(16000, 8000) + pixel), Error) << "a header that promises half a gigabyte";
    EXPECT_THROW(readBytes(header(100000, 50000) + pixel), Error) << "too large";
    EXPECT_THROW(readBytes(header(2, 2) + pixel + pixel + pixel + pixel), Error) << "not twice as wide as high";
    EXPECT_THROW(readBytes("#?RADIANCE\n"), Error);
    EXPECT_THROW(readBytes(""), Error);
    EXPECT_THROW(readEnvironmentMap("/nowhere/sky.hdr"), Error);
}

TEST_F(EnvironmentMapTest, RefusesEveryTruncationOfPackedRows) {
    // Rows of runs: 2, 2, the width, and for each of four channels one run of all columns.
    constexpr int kWidth = 32, kHeight = 16;
    const std::string run("\xa0\x80", 2), row = std::string("\x02\x02\x00\x20", 4) + run + run + run + run;
    std::string whole = header(kWidth, kHeight);
    const std::size_t begin = whole.size();
    for (int y = 0; y < kHeight; ++y) whole += row;
    EXPECT_EQ(readBytes(whole).pixels.back(), glm::vec3(0.5F));
    for (std::size_t bytes = begin; bytes < whole.size(); ++bytes)
        EXPECT_THROW(readBytes(whole.substr(0, bytes)), Error) << bytes;
    EXPECT_THROW(readBytes(whole.substr(0, begin + 4) + std::string(1000, '\0')), Error) << "runs of no pixels to its end";
}

TEST_F(EnvironmentMapTest, RefusesNegativeAndInfiniteRadianceWithItsPlace) {
    for (const float value : {-1.0F, 1e16F, std::numeric_limits<float>::infinity(), std::nanf("")}) {
        model::EnvironmentMap map{4, 2, std::vector<glm::vec3>(8, glm::vec3(1)), "sky.hdr"};
        checkEnvironmentMap(map);
        map.pixels[6].y = value;
        try {
            checkEnvironmentMap(map);
            ADD_FAILURE() << value;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("pixel (2, 1)"), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace radiata::io
