// .trk and .tt.gz files: where their points lie, their columns, byte orders and lies.
#include "io/trk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "io/tractogram.h"
#include "unit/io/tract_bytes.h"

namespace radiata::io {
namespace {

using namespace test;
using model::Tractogram;

Tractogram read(const std::filesystem::path& path) { return model::readAll(*openTractogram(path)); }

std::string failure(const std::filesystem::path& path) {
    try {
        read(path);
    } catch (const Error& error) {
        EXPECT_NE(error.code(), Code::kInternal);
        return error.what();
    }
    return "no failure";
}

TEST(Trk, TheCornerOfTheFirstVoxelIsHalfAVoxelBeforeItsCentre) {
    const TempFolder folder;
    for (const bool big : {false, true}) {
        TrkFile file;
        file.big = big;
        file.matrix = {2, 0, 0, -10, 0, 2, 0, 5, 0, 0, 2, 1, 0, 0, 0, 1};
        file.data = trkTrack(2, {1, 1, 1, 4, 2, 0}, big);
        const Tractogram tracts = read(folder.write("a.trk", trkBytes(file)));
        EXPECT_EQ(tracts.fibres.points, (std::vector<glm::vec3>{{-10, 5, 1}, {-7, 6, 0}})) << big;
        EXPECT_EQ(tracts.header.grid_size, glm::ivec3(10, 20, 30));
        EXPECT_EQ(read(folder.write("a.trk.gz", gzip(trkBytes(file)))).fibres.points, tracts.fibres.points);
    }
}

TEST(Trk, AVoxelOrderUnlikeTheMatrixIsTurnedIntoIt) {
    // Voxel (3, 4, 5) of a 10 x 20 x 30 grid, counted along the axes that the order names, at its centre.
    const TempFolder folder;
    const auto place = [&](const std::string& order, const std::array<double, 16>& matrix) {
        TrkFile file;
        file.order = order;
        file.matrix = matrix;
        file.data = trkTrack(1, {7, 9, 11});
        return read(folder.write("a.trk", trkBytes(file))).fibres.points.at(0);
    };
    const std::array<double, 16> ras{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1};
    const std::array<double, 16> lps{-2, 0, 0, 100, 0, -2, 0, 200, 0, 0, 2, 0, 0, 0, 0, 1};
    const std::array<double, 16> swapped{0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1};  // voxel axis 0 runs to P, 1 to R
    EXPECT_EQ(place("RAS", ras), glm::vec3(6, 8, 10));
    EXPECT_EQ(place("lps", lps), glm::vec3(94, 192, 10));
    EXPECT_EQ(place("LPS", ras), glm::vec3(2 * (9 - 3), 2 * (19 - 4), 10));
    EXPECT_EQ(place("LAI", ras), glm::vec3(2 * (9 - 3), 8, 2 * (29 - 5)));
    EXPECT_EQ(place("PRS", swapped), glm::vec3(8, -6, 10));
    // The order says axis 0 runs to R and axis 1 to A: voxel axis 1 is 3, voxel axis 0 is turned, 19 - 4.
    EXPECT_EQ(place("RAS", swapped), glm::vec3(6, -2 * (19 - 4), 10));
    EXPECT_EQ(place(std::string(1, '\0'), lps), glm::vec3(94, 192, 10)) << "LPS is what TrackVis means by nothing";
}

TEST(Trk, ScalarsAndPropertiesAreColumns) {
    const TempFolder folder;
    TrkFile file;
    file.scalar_names = {"fa", std::string("rgb\0"
                                           "3",
                                           5)};
    file.scalars = 5;
    file.property_names = {"bundle"};
    file.properties = 2;
    file.count = 77;  // a lie
    file.data = trkTrack(2, {1, 1, 1, 0.5, 1, 2, 3, 9, 3, 1, 1, 0.25, 4, 5, 6, 8, 42, 43}) + trkTrack(0, {44, 45});
    const Tractogram tracts = read(folder.write("a.trk", trkBytes(file)));
    EXPECT_EQ(tracts.header.vertex_columns, (std::vector<model::ColumnName>{{"fa", 1}, {"rgb", 3}, {"scalars", 1}}));
    EXPECT_EQ(tracts.header.fibre_columns, (std::vector<model::ColumnName>{{"bundle", 1}, {"properties", 1}}));
    EXPECT_EQ(tracts.fibres.vertex_values[0], (std::vector<float>{0.5, 0.25}));
    EXPECT_EQ(tracts.fibres.vertex_values[1], (std::vector<float>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(tracts.fibres.vertex_values[2], (std::vector<float>{9, 8}));
    EXPECT_EQ(tracts.fibres.fibre_values[0], (std::vector<float>{42, 44}));
    EXPECT_EQ(tracts.fibres.offsets, (std::vector<std::uint64_t>{0, 2, 2}));
}

TEST(Trk, BadFilesAreRefusedWithASentence) {
    const TempFolder folder;
    const auto with = [&](const std::function<void(TrkFile&)>& change) {
        TrkFile file;
        file.data = trkTrack(2, {1, 1, 1, 4, 2, 0});
        change(file);
        return failure(folder.write("a.trk", trkBytes(file)));
    };
    EXPECT_EQ(with([](TrkFile&) {}), "no failure");
    EXPECT_THAT(with([](TrkFile& f) { f.data.resize(17); }),
                testing::HasSubstr("the file ends at byte 1017, within the points of track 0"));
    EXPECT_THAT(with([](TrkFile& f) {
                    f.data = trkTrack(2000000000, {1, 2, 3});
                }),
                testing::HasSubstr("within the points of track 0"));
    EXPECT_THAT(with([](TrkFile& f) { f.data = trkTrack(-3, {}); }),
                testing::HasSubstr("track 0 at byte 1000 claims -3 points"));
    EXPECT_THAT(with([](TrkFile& f) { f.order = "RRS"; }), testing::HasSubstr("the header's voxel order is 'RRS'"));
    EXPECT_THAT(with([](TrkFile& f) { f.matrix[0] = 0; }), testing::HasSubstr("vox_to_ras matrix is singular"));
    EXPECT_THAT(with([](TrkFile& f) { f.matrix[3] = kNanNumber; }), testing::HasSubstr("vox_to_ras matrix is not finite"));
    EXPECT_THAT(with([](TrkFile& f) { f.voxel[1] = -2; }), testing::HasSubstr("the header's voxel size is -2"));
    EXPECT_THAT(with([](TrkFile& f) { f.version = 9; }), testing::HasSubstr("is of version 9"));
    EXPECT_THAT(with([](TrkFile& f) { f.header_size = 900; }), testing::HasSubstr("the header's size is given as 900"));
    EXPECT_THAT(with([](TrkFile& f) {
                    f.scalars = -5;
                    f.scalar_names = {};
                }),
                testing::HasSubstr("n_scalars is -5"));
    EXPECT_THAT(failure(folder.write("a.trk", "TRACK")), testing::HasSubstr("within the header of 1000"));
    EXPECT_THAT(failure(folder.write("a.trk", std::string(2000, 'x'))), testing::HasSubstr("not with 'TRACK'"));
}

TEST(Tt, PointsAreDeltasOfA32ndVoxelPlacedByTheMatrix) {
    const TempFolder folder;
    for (const bool packed : {false, true}) {
        const Tractogram tracts = read(packed ? folder.write("a.tt.gz", gzip(ttBytes())) : folder.write("a.tt", ttBytes()));
        EXPECT_EQ(tracts.fibres.offsets, (std::vector<std::uint64_t>{0, 3, 4}));
        EXPECT_EQ(tracts.fibres.points,
                  (std::vector<glm::vec3>{{76, 72, -52}, {75, 72, -52}, {75, 72.5, -51.75}, {58, 76, -50}}));
        EXPECT_EQ(tracts.header.grid_size, glm::ivec3(10, 20, 30));
    }
}

TEST(Tt, MatricesMayStandInAnyOrderAndClustersAreAColumn) {
    const TempFolder folder;
    const std::string tracks = ttTrack({32, 64, -32}, {{16, 0, 0}}), more = ttTrack({0, 0, 0}, {});
    const std::string bytes = matMatrix("track", 50, tracks.size(), tracks) + matMatrix("track2", 50, more.size(), more) +
                              matMatrix("cluster", 20, 2, encode({7, 9}, "int32", false)) +
                              matMatrix("voxel_size", 10, 3, encode({2, 2, 2}, "float32", false));
    const Tractogram tracts = read(folder.write("a.tt", bytes));
    EXPECT_EQ(tracts.fibres.points, (std::vector<glm::vec3>{{-2, -4, -2}, {-3, -4, -2}, {0, 0, 0}}));
    EXPECT_EQ(tracts.fibres.fibre_values.at(0), (std::vector<float>{7, 9}));
    EXPECT_THAT(tracts.header.remarks, testing::HasSubstr("no matrix trans_to_mni"));
}

TEST(Tt, BadFilesAreRefusedWithASentence) {
    const TempFolder folder;
    const std::string good = ttBytes();
    EXPECT_THAT(failure(folder.write("a.tt", good.substr(0, good.size() - 3))),
                testing::HasSubstr("the header promises data up to byte"));
    const std::string tracks = encode({7}, "uint32", false) + std::string(40, '\0');
    EXPECT_THAT(failure(folder.write("a.tt", matMatrix("voxel_size", 10, 3, encode({2, 2, 2}, "float32", false)) +
                                                 matMatrix("track", 50, tracks.size(), tracks))),
                testing::HasSubstr("track 0 claims 7 coordinates"));
    EXPECT_THAT(failure(folder.write("a.tt", matMatrix("dimension", 20, 3, encode({1, 1, 1}, "int32", false)))),
                testing::HasSubstr("has no matrix 'track' of bytes"));
    EXPECT_THAT(failure(folder.write("a.tt", std::string(100, '\x77'))), testing::HasSubstr("no MATLAB 4 matrix"));
    for (std::size_t size = 1; size < good.size(); size += 5) {
        EXPECT_NE(failure(folder.write("b.tt", good.substr(0, size))), "no failure") << size;
    }
}

}  // namespace
}  // namespace radiata::io
