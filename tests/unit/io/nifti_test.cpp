// NIfTI files made byte by byte: versions, types, byte orders, scaling, matrices.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "io/volume.h"
#include "unit/io/image_bytes.h"

namespace radiata::io {
namespace {

using test::NiftiFile;

/// 2 x 3 x 2 x 2 numbers that every type can hold; distinct, so that a wrong order shows.
std::vector<double> counting() {
    std::vector<double> values(24);
    std::iota(values.begin(), values.end(), 1.0);
    return values;
}

NiftiFile counted(const std::string& type, int version = 1, bool big_endian = false) {
    NiftiFile file;
    file.version = version;
    file.big_endian = big_endian;
    file.dim = {2, 3, 2, 2};
    file.datatype = test::niftiDatatype(type);
    file.data = test::encode(counting(), type, big_endian);
    return file;
}

void expectCounted(const Volume& volume, double slope = 1, double intercept = 0) {
    EXPECT_EQ(volume.size, (std::array<std::int64_t, 4>{2, 3, 2, 2}));
    ASSERT_EQ(volume.data.size(), 24U);
    for (std::size_t i = 0; i < 24; ++i) {
        EXPECT_EQ(volume.data[i], static_cast<float>(static_cast<double>(i + 1) * slope + intercept)) << i;
    }
}

TEST(Nifti, ReadsEveryTypeInBothVersionsAndByteOrdersPlainAndCompressed) {
    const test::TempFolder folder;
    for (const std::string type :
         {"int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64", "float128"}) {
        for (const int version : {1, 2}) {
            for (const bool big : {false, true}) {
                SCOPED_TRACE(type + " version " + std::to_string(version) + (big ? " big" : " little"));
                const std::string bytes = test::bytes(counted(type, version, big));
                expectCounted(readVolume(folder.write("a.nii", bytes)));
                expectCounted(readVolume(folder.write("a.nii.gz", test::gzip(bytes))));
            }
        }
    }
}

TEST(Nifti, KeepsSignsAndExtremesOfIntegers) {
    const test::TempFolder folder;
    NiftiFile file;
    file.dim = {2};
    file.datatype = test::niftiDatatype("int16");
    file.data = test::encode({-32768, 32767}, "int16", false);
    EXPECT_EQ(readVolume(folder.write("a.nii", test::bytes(file))).data, (std::vector<float>{-32768, 32767}));
    file.datatype = test::niftiDatatype("uint64");
    file.data = std::string(8, '\xff') + std::string(8, '\0');
    EXPECT_EQ(readVolume(folder.write("a.nii", test::bytes(file))).data, (std::vector<float>{18446744073709551616.0F, 0}));
    file.datatype = test::niftiDatatype("int64");
    file.data = std::string(8, '\xff') + std::string(7, '\0') + '\x80';
    EXPECT_EQ(readVolume(folder.write("a.nii", test::bytes(file))).data, (std::vector<float>{-1, -9223372036854775808.0F}));
}

TEST(Nifti, KeepsFloatsBitByBitAndTurnsTooLargeDoublesIntoInfinity) {
    const test::TempFolder folder;
    const double nan = std::nan(""), denormal = 1e-41;
    NiftiFile file;
    file.dim = {4};
    file.data = test::encode({nan, -0.0, denormal, 0.1F}, "float32", false);
    const std::vector<float> values = readVolume(folder.write("a.nii", test::bytes(file))).data;
    EXPECT_EQ(std::memcmp(values.data(), file.data.data(), 16), 0);
    file.datatype = test::niftiDatatype("float64");
    file.data = test::encode({1e300, -1e300, 1e-300, nan}, "float64", false);
    const std::vector<float> doubles = readVolume(folder.write("a.nii", test::bytes(file))).data;
    EXPECT_EQ(doubles[0], std::numeric_limits<float>::infinity());
    EXPECT_EQ(doubles[1], -std::numeric_limits<float>::infinity());
    EXPECT_EQ(doubles[2], 0);
    EXPECT_TRUE(std::isnan(doubles[3]));
}

TEST(Nifti, AppliesScalingAndIgnoresItWhereTheStandardSays) {
    const test::TempFolder folder;
    NiftiFile file = counted("int16");
    file.slope = 0.25;
    file.intercept = -7;
    expectCounted(readVolume(folder.write("a.nii", test::bytes(file))), 0.25, -7);
    for (const double unscaled : {0.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        file.slope = unscaled;
        expectCounted(readVolume(folder.write("a.nii", test::bytes(file))));
    }
    file.slope = 2;
    file.intercept = std::nan("");
    expectCounted(readVolume(folder.write("a.nii", test::bytes(file))), 2, 0);
}

TEST(Nifti, PrefersTheSformToTheQform) {
    const test::TempFolder folder;
    NiftiFile file = counted("uint8");
    file.srow = {-1.5, 0.25, 0, 12.5, 0.5, 2, 0, -3, 0, 0.125, 2.5, 7};
    file.qform_code = 1;
    file.quatern = {0, 0, 0, 99, 99, 99};
    file.pixdim[4] = std::nan("");
    for (const int version : {1, 2}) {
        file.version = version;
        const glm::dmat4 m = readVolume(folder.write("a.nii", test::bytes(file))).voxel_to_world;
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 4; ++c) EXPECT_EQ(m[c][r], file.srow[static_cast<std::size_t>(4 * r + c)]);
        }
        EXPECT_EQ(glm::transpose(m)[3], glm::dvec4(0, 0, 0, 1));
    }
}

TEST(Nifti, BuildsTheQformFromItsQuaternion) {
    // b = sin(45 degrees), c = d = 0: a quarter turn about x; qfac -1 flips the third axis. Bound 1e-6: NIfTI-1 floats.
    const test::TempFolder folder;
    NiftiFile file = counted("uint8");
    file.sform_code = 0;
    file.qform_code = 2;
    file.quatern = {std::sqrt(0.5), 0, 0, 10, 20, 30};
    file.pixdim = {-1, 2, 3, 4, 0, 0, 0, 0};
    for (const int version : {1, 2}) {
        file.version = version;
        const glm::dmat4 m = readVolume(folder.write("a.nii", test::bytes(file))).voxel_to_world;
        const glm::dmat4 expected(glm::dvec4(2, 0, 0, 0), glm::dvec4(0, 0, 3, 0), glm::dvec4(0, 4, 0, 0),
                                  glm::dvec4(10, 20, 30, 1));
        for (int c = 0; c < 4; ++c) EXPECT_LT(glm::length(m[c] - expected[c]), 1e-6) << "column " << c;
    }
}

TEST(Nifti, FallsBackToVoxelSizes) {
    const test::TempFolder folder;
    NiftiFile file = counted("uint8");
    file.sform_code = 0;
    file.pixdim = {1, 2, 3, 0.5, 0, 0, 0, 0};
    const glm::dmat4 m = readVolume(folder.write("a.nii", test::bytes(file))).voxel_to_world;
    EXPECT_EQ(m, glm::dmat4(glm::dvec4(2, 0, 0, 0), glm::dvec4(0, 3, 0, 0), glm::dvec4(0, 0, 0.5, 0), glm::dvec4(0, 0, 0, 1)));
}

TEST(Nifti, SkipsExtensionsAndIgnoresWhatFollowsTheSamples) {
    const test::TempFolder folder;
    NiftiFile file = counted("float32");
    file.vox_offset = 352 + 64;
    file.data = std::string(64, 'x') + file.data + "trailing";
    expectCounted(readVolume(folder.write("a.nii", test::bytes(file))));
    expectCounted(readVolume(folder.write("a.nii.gz", test::gzip(test::bytes(file)))));
    file = counted("float32", 2);
    file.vox_offset = 0;
    expectCounted(readVolume(folder.write("a.nii", test::bytes(file))));
}

TEST(Nifti, TakesVolumesFromTheFifthAxisToo) {
    const test::TempFolder folder;
    NiftiFile file = counted("float32");
    file.dim = {2, 3, 2, 1, 2};
    expectCounted(readVolume(folder.write("a.nii", test::bytes(file))));
    file.dim = {2, 3, 2, 2, 1, 1, 1};
    expectCounted(readVolume(folder.write("a.nii", test::bytes(file))));
    file.dim = {2, 3, 1, 2, 2};
    EXPECT_THROW(readVolume(folder.write("a.nii", test::bytes(file))), Error);
}

TEST(Nifti, ReadsMembersOfAConcatenatedGzipFile) {
    const test::TempFolder folder;
    const std::string bytes = test::bytes(counted("float32"));
    expectCounted(readVolume(folder.write("a.nii.gz", test::gzip(bytes.substr(0, 400)) + test::gzip(bytes.substr(400)))));
}

}  // namespace
}  // namespace radiata::io
