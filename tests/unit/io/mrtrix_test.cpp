// MRtrix files made byte by byte: types, axis orders, scaling, matrices, data beside the header.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "io/volume.h"
#include "unit/io/image_bytes.h"

namespace radiata::io {
namespace {

constexpr std::array<std::int64_t, 4> kSize{2, 3, 4, 5};

double valueAt(std::int64_t x, std::int64_t y, std::int64_t z, std::int64_t v) {
    return static_cast<double>(1 + x + 2 * (y + 3 * (z + 4 * v)));
}

test::MrtrixFile counted(const std::string& layout, const std::string& type, const std::string& name) {
    test::MrtrixFile file = test::mrtrixFile({2, 3, 4, 5}, layout, name);
    file.data = test::encode(test::inLayout(kSize, layout, valueAt), type, name.ends_with("BE"));
    return file;
}

void expectCounted(const Volume& volume, double slope = 1, double intercept = 0) {
    EXPECT_EQ(volume.size, kSize);
    ASSERT_EQ(volume.data.size(), 120U);
    for (std::size_t i = 0; i < volume.data.size(); ++i) {
        ASSERT_EQ(volume.data[i], static_cast<float>(static_cast<double>(i + 1) * slope + intercept)) << i;
    }
}

TEST(Mrtrix, ReadsEveryTypeInBothByteOrders) {
    const test::TempFolder folder;
    const std::vector<std::pair<std::string, std::string>> types{
        {"int8", "Int8"},         {"uint8", "UInt8"},       {"int16", "Int16LE"},     {"int16", "Int16BE"},
        {"uint16", "UInt16LE"},   {"uint16", "UInt16BE"},   {"int32", "Int32LE"},     {"int32", "Int32BE"},
        {"uint32", "UInt32LE"},   {"uint32", "UInt32BE"},   {"int64", "Int64LE"},     {"int64", "Int64BE"},
        {"uint64", "UInt64LE"},   {"uint64", "UInt64BE"},   {"float32", "Float32LE"}, {"float32", "Float32BE"},
        {"float64", "Float64LE"}, {"float64", "Float64BE"}, {"float32", "Float32"},   {"float32", "float32le"}};
    for (const auto& [type, name] : types) {
        SCOPED_TRACE(name);
        const std::string bytes = test::mifBytes(counted("+3,-1,+0,-2", type, name));
        expectCounted(readVolume(folder.write("a.mif", bytes)));
        expectCounted(readVolume(folder.write("a.mif.gz", test::gzip(bytes))));
    }
}

TEST(Mrtrix, ReadsBitsHighestFirst) {
    const test::TempFolder folder;
    test::MrtrixFile file = test::mrtrixFile({11}, "+0", "Bit");
    file.data = std::string("\xA1\x60", 2);
    EXPECT_EQ(readVolume(folder.write("a.mif", test::mifBytes(file))).data,
              (std::vector<float>{1, 0, 1, 0, 0, 0, 0, 1, 0, 1, 1}));
    set(file, "scaling", "3,-2");
    EXPECT_EQ(readVolume(folder.write("a.mif", test::mifBytes(file))).data,
              (std::vector<float>{1, 3, 1, 3, 3, 3, 3, 1, 3, 1, 1}));
}

TEST(Mrtrix, ReadsEveryOrderAndDirectionOfTheAxes) {
    const test::TempFolder folder;
    std::array<int, 4> rank{0, 1, 2, 3};
    do {
        for (int signs = 0; signs < 16; ++signs) {
            std::string layout;
            for (int axis = 0; axis < 4; ++axis) {
                layout += std::string(axis ? "," : "") + ((signs >> axis & 1) != 0 ? "-" : "+") +
                          std::to_string(rank[static_cast<std::size_t>(axis)]);
            }
            SCOPED_TRACE(layout);
            expectCounted(readVolume(folder.write("a.mif", test::mifBytes(counted(layout, "float32", "Float32LE")))));
        }
    } while (std::ranges::next_permutation(rank).found);
}

TEST(Mrtrix, LayoutNumbersNeedOnlyBeInOrder) {
    const test::TempFolder folder;
    test::MrtrixFile file = counted("+1,+2,+3,+0", "float32", "Float32LE");
    set(file, "layout", "+4,+7,+9,+1");
    expectCounted(readVolume(folder.write("a.mif", test::mifBytes(file))));
    set(file, "layout", "4 7 9 1");
    expectCounted(readVolume(folder.write("a.mif", test::mifBytes(file))));
}

TEST(Mrtrix, DropsAxesOfLengthOne) {
    const test::TempFolder folder;
    test::MrtrixFile file = counted("+1,+2,+3,+0", "float32", "Float32LE");
    set(file, "dim", "2,3,4,1,5");
    set(file, "layout", "+1,+2,+3,+4,+0");
    expectCounted(readVolume(folder.write("a.mif", test::mifBytes(file))));
}

TEST(Mrtrix, AppliesScalingOffsetFirstThenFactor) {
    const test::TempFolder folder;
    test::MrtrixFile file = counted("+0,+1,+2,+3", "int16", "Int16LE");
    set(file, "scaling", "-3,0.5");
    expectCounted(readVolume(folder.write("a.mif", test::mifBytes(file))), 0.5, -3);
}

TEST(Mrtrix, MultipliesTransformByVoxelSizes) {
    const test::TempFolder folder;
    test::MrtrixFile file = counted("+0,+1,+2,+3", "uint8", "UInt8");
    set(file, "vox", "2,3,4,nan");
    set(file, "transform", "0, -1, 0, 10");
    file.lines.emplace_back("transform", "1, 0, 0, -20");
    file.lines.emplace_back("transform", "0, 0, 1, 1e1");
    const glm::dmat4 expected(glm::dvec4(0, 2, 0, 0), glm::dvec4(-3, 0, 0, 0), glm::dvec4(0, 0, 4, 0),
                              glm::dvec4(10, -20, 10, 1));
    EXPECT_EQ(readVolume(folder.write("a.mif", test::mifBytes(file))).voxel_to_world, expected);
    file.lines.emplace_back("transform", "0, 0, 0, 1");
    EXPECT_EQ(readVolume(folder.write("a.mif", test::mifBytes(file))).voxel_to_world, expected);
}

TEST(Mrtrix, CentresAnImageWithoutTransform) {
    const test::TempFolder folder;
    test::MrtrixFile file = counted("+0,+1,+2,+3", "uint8", "UInt8");
    set(file, "vox", "2,3,4,1");
    set(file, "transform", "");
    const glm::dmat4 m = readVolume(folder.write("a.mif", test::mifBytes(file))).voxel_to_world;
    EXPECT_EQ(m[3], glm::dvec4(-1, -3, -6, 1));
}

TEST(Mrtrix, ReadsDataBesideTheHeader) {
    const test::TempFolder folder;
    const test::MrtrixFile file = counted("-0,+1,-2,+3", "float64", "Float64BE");
    folder.write("a.dat", file.data);
    folder.write("deep/b.dat", "12345" + file.data);
    expectCounted(readVolume(folder.write("a.mih", test::mihText(file, "a.dat"))));
    expectCounted(readVolume(folder.write("a.mih", test::mihText(file, "a.dat 0"))));
    expectCounted(readVolume(folder.write("a.mih", test::mihText(file, "deep/b.dat 5"))));
    expectCounted(readVolume(folder.write("a.mih", test::mihText(file, "./deep/b.dat   5"))));
    const std::string text = test::mihText(file, "a.dat");
    expectCounted(readVolume(folder.write("a.mih", text.substr(0, text.size() - 4))));
    EXPECT_EQ(text.substr(text.size() - 4), "END\n") << "a header without END ends with its file";
}

TEST(Mrtrix, UnderstandsOtherKeysCommentsAndLineEnds) {
    const test::TempFolder folder;
    test::MrtrixFile file = counted("+0,+1,+2,+3", "uint8", "UInt8");
    file.lines.emplace_back("command_history", "mrconvert a: b END");
    file.lines.emplace_back("# a comment", "anything");
    file.lines.emplace_back("ENDING", "is not the end");
    expectCounted(readVolume(folder.write("a.mif", test::mifBytes(file))));
    for (auto& line : file.lines) line.second += "\r";
    file.first_line += "\r";
    expectCounted(readVolume(folder.write("a.mif", test::mifBytes(file))));
}

TEST(Mrtrix, ReadsHeadersLongerThanOneBlock) {
    // Headers around 64 KiB, so that END meets the border between two reads in every way.
    const test::TempFolder folder;
    for (std::size_t extra = 65200; extra < 65560; extra += 3) {
        test::MrtrixFile file = counted("+0,+1,+2,+3", "uint8", "UInt8");
        file.lines.emplace_back("comments", std::string(extra - 200, 'c'));
        expectCounted(readVolume(folder.write("a.mif", test::mifBytes(file))));
    }
}

}  // namespace
}  // namespace radiata::io
