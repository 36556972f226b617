// Lines of .vtp files: every packing, several pieces, columns, axes, and files that contradict themselves.
#include "io/vtp_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "io/tractogram.h"
#include "unit/io/vtp_writer.h"

namespace radiata::io {
namespace {

using namespace test;
using model::Tractogram;
using testing::HasSubstr;

Tractogram read(const std::string& bytes, VtkSpace space = VtkSpace::kAuto) {
    const TempFolder folder;
    TractOptions options;
    options.vtk_space = space;
    return model::readAll(*openTractogram(folder.write("a.vtp", bytes), options));
}

std::string failure(const std::string& bytes) {
    try {
        read(bytes);
    } catch (const Error& error) {
        EXPECT_NE(error.code(), Code::kInternal);
        return error.what();
    }
    return "no failure";
}

std::string with(std::string bytes, const std::string& from, const std::string& to) {
    EXPECT_NE(bytes.find(from), std::string::npos) << from;
    return bytes.replace(bytes.find(from), from.size(), to);
}

std::vector<VtpFile> packings() {
    std::vector<VtpFile> all(1);
    for (const std::string format : {"binary", "appended"}) {
        for (int bits = 0; bits < 16; ++bits) {
            VtpFile file;
            file.format = format;
            file.raw = (bits & 1) != 0;
            file.big = (bits & 2) != 0;
            file.zlib = (bits & 4) != 0;
            if ((bits & 8) != 0) {
                file.header_type = "UInt64";
                file.point_type = "Float64";
                file.id_type = "Int64";
            }
            all.push_back(file);
        }
    }
    return all;
}

TEST(VtpLines, AllPackingsAreTheSame) {
    for (const VtpFile& file : packings()) {
        SCOPED_TRACE(file.format + (file.raw ? " raw" : "") + (file.big ? " big" : "") + (file.zlib ? " zlib " : " ") +
                     file.header_type);
        const Tractogram tracts = read(vtpBytes(file));
        EXPECT_EQ(tracts.fibres.offsets, (std::vector<std::uint64_t>{0, 3, 5}));
        EXPECT_EQ(tracts.fibres.points,
                  (std::vector<glm::vec3>{{1, 2, 3}, {1.5, 2, 3}, {2, 2, 3}, {-7, 8, -9}, {-7, 8.5, -9}}));
        EXPECT_EQ(tracts.header.vertex_columns, (std::vector<model::ColumnName>{{"fa", 1}}));
        EXPECT_EQ(tracts.fibres.vertex_values.at(0), (std::vector<float>{0.1F, 0.2F, 0.3F, 0.4F, 0.5F}));
        EXPECT_EQ(tracts.header.fibre_columns, (std::vector<model::ColumnName>{{"id", 2}}));
        EXPECT_EQ(tracts.fibres.fibre_values.at(0), (std::vector<float>{1, 2, 3, 4}));
    }
}

TEST(VtpLines, PiecesFollowEachOther) {
    VtpFile file;
    file.format = "appended";
    file.pieces = 3;
    const std::string bytes = vtpBytes(file);
    const Tractogram tracts = read(bytes);
    EXPECT_EQ(tracts.fibres.offsets, (std::vector<std::uint64_t>{0, 3, 5, 8, 10, 13, 15}));
    EXPECT_EQ(tracts.fibres.points.at(13), glm::vec3(-7, 8, -9));
    EXPECT_EQ(tracts.fibres.fibre_values.at(0).size(), 12U);
    const std::size_t second = bytes.find("\"fa\"", bytes.find("\"fa\"") + 1);
    EXPECT_THAT(failure(std::string(bytes).replace(second, 4, "\"md\"")),
                HasSubstr("piece 1 has no array 'fa' of 1 components"));
}

TEST(VtpLines, LinesMayTakePointsInAnyOrderAndShareThem) {
    VtpFile file;
    file.format = "binary";
    file.zlib = true;
    file.ids = {4, 1, 2, 1, 0};
    const Tractogram tracts = read(vtpBytes(file));
    EXPECT_EQ(tracts.fibres.points, (std::vector<glm::vec3>{{-7, 8.5, -9}, {1.5, 2, 3}, {2, 2, 3}, {1.5, 2, 3}, {1, 2, 3}}));
    EXPECT_EQ(tracts.fibres.vertex_values.at(0), (std::vector<float>{0.5F, 0.2F, 0.3F, 0.2F, 0.1F}));
}

TEST(VtpLines, AxesAreThoseOfCommentOrFieldOrAsAskedFor) {
    VtpFile file;
    EXPECT_THAT(read(vtpBytes(file)).header.remarks, HasSubstr("RAS is assumed"));
    EXPECT_EQ(read(vtpBytes(file), VtkSpace::kLps).fibres.points.at(3), glm::vec3(7, -8, -9));
    for (const std::string head : {"<!-- 3D Slicer output. SPACE=LPS -->",
                                   "<FieldData><Array type=\"String\" Name=\"SPACE\" NumberOfTuples=\"1\" format=\"ascii\">"
                                   "76 80 83 0</Array></FieldData>"}) {
        file.head = head;
        EXPECT_EQ(read(vtpBytes(file)).fibres.points.at(3), glm::vec3(7, -8, -9)) << head;
        EXPECT_EQ(read(vtpBytes(file)).header.remarks, "");
        EXPECT_EQ(read(vtpBytes(file), VtkSpace::kRas).fibres.points.at(3), glm::vec3(-7, 8, -9));
    }
}

TEST(VtpLines, FibresWithPointsThatAreNotFiniteAreLeftOutAndCounted) {
    const TempFolder folder;
    const auto source = openTractogram(folder.write("a.vtp", with(vtpBytes({}), "1.500000", "nan")));
    model::FibreBatch batch;
    ASSERT_TRUE(source->read(batch, 1000));
    EXPECT_EQ(batch.offsets, (std::vector<std::uint64_t>{0, 0, 2}));
    EXPECT_EQ(source->damagedFibres(), 1U);
}

TEST(VtpLines, BadTextIsRefusedWithASentence) {
    const std::string good = vtpBytes({});
    EXPECT_THAT(failure(with(good, "\"PolyData\"", "\"ImageData\"")), HasSubstr("lines are read from PolyData only"));
    EXPECT_THAT(failure(with(good, "header_type=\"UInt32\"", "header_type=\"UInt16\"")),
                HasSubstr("UInt32 and UInt64 are read"));
    EXPECT_THAT(failure(with(good, "header_type", "compressor=\"vtkLZ4DataCompressor\" header_type")),
                HasSubstr("'vtkLZ4DataCompressor'; only vtkZLibDataCompressor and no compressor are read"));
    EXPECT_THAT(failure(with(good, "LittleEndian", "Middle")), HasSubstr("must be LittleEndian or BigEndian"));
    EXPECT_THAT(failure(with(good, "NumberOfPoints=\"5\"", "NumberOfPoints=\"-5\"")),
                HasSubstr("'-5', which is no usable count"));
    EXPECT_THAT(failure(with(good, "NumberOfPoints=\"5\"", "NumberOfPoints=\"99999999999\"")), HasSubstr("its text has"));
    EXPECT_THAT(failure(with(good, "NumberOfLines=\"2\"", "NumberOfLines=\"3\"")), HasSubstr("ends too early"));
    EXPECT_THAT(failure(with(good, "NumberOfLines=\"2\"", "NumberOfLines=\"0\"")), HasSubstr("none of them are lines"));
    EXPECT_THAT(failure(with(good, "NumberOfComponents=\"3\"", "NumberOfComponents=\"2\"")), HasSubstr("they must have 3"));
    EXPECT_THAT(failure(with(good, "format=\"ascii\"", "format=\"text\"")), HasSubstr("ascii, binary and appended are read"));
    EXPECT_THAT(failure(with(good, "format=\"ascii\"", "format=\"appended\" offset=\"0\"")),
                HasSubstr("there is no AppendedData"));
    EXPECT_THAT(failure(with(good, "\"connectivity\"", "\"ids\"")), HasSubstr("has no connectivity of lines"));
    EXPECT_THAT(failure(with(good, "0\n1\n2\n3\n4", "0\n1\n2\n3\n5")),
                HasSubstr("line 1 names point 5; there are 5, counted from 0"));
    EXPECT_THAT(failure(with(good, "3\n5\n", "3\n2\n")), HasSubstr("offsets must ascend"));
    EXPECT_THAT(failure(with(good, "3\n5\n", "3\n6\n")), HasSubstr("'connectivity of lines' ends too early"));
    EXPECT_THAT(failure(with(good, "-7.000000", "seven")), HasSubstr("'seven', which is no number"));
    EXPECT_THAT(failure(with(good, "</Points>", "</Point>")), HasSubstr("is no well-formed XML"));
    EXPECT_THAT(failure(std::string(3U << 20, '<')), HasSubstr("elements and attributes"));
    for (std::size_t size = 1; size + 12 < good.size(); size += 37) {
        EXPECT_NE(failure(good.substr(0, size)), "no failure") << size;
    }
}

TEST(VtpLines, BadBytesAreRefusedWithASentence) {
    VtpFile file;
    file.format = "binary";
    std::string good = vtpBytes(file);
    const std::string points = vtpPacked(file, encode({1, 2, 3, 1.5, 2, 3, 2, 2, 3, -7, 8, -9, -7, 8.5, -9}, "float32", false));
    EXPECT_THAT(failure(with(good, points, points.substr(0, 42))),
                HasSubstr("'points' claims 60 bytes; the file has room for"));
    EXPECT_THAT(failure(with(good, points, points.substr(0, points.size() - 2))), HasSubstr("its base64 stops"));
    EXPECT_THAT(failure(with(good, points, with(points, points.substr(8, 1), "*"))),
                HasSubstr("'*' where base64 should go on"));
    EXPECT_THAT(failure(with(good, "NumberOfPoints=\"5\"", "NumberOfPoints=\"4\"")),
                HasSubstr("numbers that the piece should have"));
    file.zlib = true;
    file.format = "appended";
    file.raw = true;
    good = vtpBytes(file);
    EXPECT_THAT(failure(with(good, "offset=\"0\"", "offset=\"99999\"")), HasSubstr("'fa' has the offset 99999; there are"));
    const std::size_t begin = good.find(" _") + 2;  // of fa: 20 bytes in blocks of 16 and 4
    const auto changed = [&](std::size_t at, const std::vector<double>& words) {
        return failure(std::string(good).replace(begin + at, 4 * words.size(), encode(words, "uint32", false)));
    };
    EXPECT_THAT(changed(0, {4e9}), HasSubstr("claims 4000000000 blocks"));
    EXPECT_THAT(changed(4, {0}), HasSubstr("claims blocks of 0 bytes"));
    EXPECT_THAT(changed(4, {4e9}), HasSubstr("numbers that the piece should have"));
    EXPECT_THAT(changed(12, {4e9}), HasSubstr("block 0 of 16 bytes takes 4000000000"));
    EXPECT_THAT(changed(24, {0}), HasSubstr("block 0 that is no sound zlib data of 16 bytes"));
    for (std::size_t size = good.find("<Lines"); size < good.size() - 60; size += 29) {
        EXPECT_NE(failure(good.substr(0, size)), "no failure") << size;
    }
}

}  // namespace
}  // namespace radiata::io
