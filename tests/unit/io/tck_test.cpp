// .tck files and the columns beside them: every data type and byte order, and every oddity that is met in the field.
#include "io/tck.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "base/error.h"
#include "io/tractogram.h"
#include "unit/io/tract_bytes.h"

namespace radiata::io {
namespace {

using namespace test;
using model::Tractogram;

Tractogram read(const std::filesystem::path& path, const TractOptions& options = {}) {
    return model::readAll(*openTractogram(path, options));
}

std::string failure(const std::filesystem::path& path, const TractOptions& options = {}) {
    try {
        read(path, options);
    } catch (const Error& error) {
        EXPECT_NE(error.code(), Code::kInternal);
        return error.what();
    }
    return "no failure";
}

void expectTwoTracks(const Tractogram& tracts) {
    EXPECT_EQ(tracts.fibres.offsets, (std::vector<std::uint64_t>{0, 3, 4}));
    ASSERT_EQ(tracts.fibres.points.size(), 4U);
    EXPECT_EQ(tracts.fibres.points[2], glm::vec3(2, 2.25, 3));
    EXPECT_EQ(tracts.fibres.points[3], glm::vec3(-7, 8, -9));
}

TEST(Tck, EveryTypeAndByteOrderIsReadExactly) {
    const TempFolder folder;
    for (const std::string type : {"Float32", "Float64"}) {
        for (const bool big : {false, true}) {
            const std::string name = type + (big ? "BE" : "LE");
            const std::string bytes = tckBytes(tckLines(name), twoTracks(), type == "Float32" ? "float32" : "float64", big);
            expectTwoTracks(read(folder.write("a.tck", bytes)));
            expectTwoTracks(read(folder.write("a.tck.gz", gzip(bytes))));
        }
    }
}

TEST(Tck, WrongAndMissingCountsAreHintsOnly) {
    const TempFolder folder;
    for (const std::string count : {"0", "1", "0000001000", "many", "99999999999999999999"}) {
        expectTwoTracks(read(folder.write("a.tck", tckBytes(tckLines("Float32LE", count), twoTracks()))));
    }
    const auto source =
        openTck(folder.write("a.tck", tckBytes({"mrtrix tracks", "datatype: Float32LE", "file: . 200"}, twoTracks())));
    EXPECT_FALSE(source->header().fibre_count.has_value());
}

TEST(Tck, MissingFieldsAreAssumedAndSaid) {
    const TempFolder folder;
    const Tractogram tracts = read(folder.write(
        "a.tck", tckBytes({"mrtrix tracks", "comment: two", "lines without a key"}, twoTracks(), "float32", false, 0)));
    expectTwoTracks(tracts);
    EXPECT_THAT(tracts.header.remarks, testing::HasSubstr("names no datatype; Float32LE"));
    EXPECT_THAT(tracts.header.remarks, testing::HasSubstr("right after END"));
}

TEST(Tck, EmptyTracksKeepTheirNumbersAndTheLastNeedsNoSeparator) {
    const TempFolder folder;
    const std::vector<double> numbers = flat({{kNanNumber, kNanNumber, kNanNumber},
                                              {1, 1, 1},
                                              {kNanNumber, kNanNumber, kNanNumber},
                                              {kNanNumber, kNanNumber, kNanNumber},
                                              {2, 2, 2},
                                              {kInfNumber, kInfNumber, kInfNumber},
                                              {5, 5, 5}});
    const Tractogram tracts = read(folder.write("a.tck", tckBytes(tckLines(), numbers)));
    EXPECT_EQ(tracts.fibres.offsets, (std::vector<std::uint64_t>{0, 0, 1, 1, 2}));
    EXPECT_EQ(tracts.measures.empty_fibres, 2U);
    EXPECT_EQ(read(folder.write("b.tck", tckBytes(tckLines(), flat({{kInfNumber, kInfNumber, kInfNumber}})))).fibreCount(), 0U);
}

TEST(Tck, ATrackWithUnusableCoordinatesIsLeftOutAndCounted) {
    const TempFolder folder;
    for (const double bad : {kNanNumber, kInfNumber, 2e5}) {
        std::vector<double> numbers = twoTracks();
        numbers[4] = bad;
        const Tractogram tracts = read(folder.write("a.tck", tckBytes(tckLines(), numbers)));
        EXPECT_EQ(tracts.fibres.offsets, (std::vector<std::uint64_t>{0, 0, 1}));
        EXPECT_EQ(tracts.measures.damaged_fibres, 1U);
        EXPECT_EQ(tracts.fibres.points.at(0), glm::vec3(-7, 8, -9));
    }
}

TEST(Tck, ManySmallBatchesMakeTheSame) {
    const TempFolder folder;
    std::vector<double> numbers;
    for (int f = 0; f < 300; ++f) {
        for (int i = 0; i < 1 + (f * 37) % 900; ++i) numbers.insert(numbers.end(), {f * 0.5, i * 0.25, 1.0});
        numbers.insert(numbers.end(), 3, kNanNumber);
    }
    numbers.insert(numbers.end(), 3, kInfNumber);
    const auto path = folder.write("a.tck", tckBytes(tckLines(), numbers));
    const Tractogram all = read(path);
    EXPECT_EQ(all.fibreCount(), 300U);
    const auto source = openTck(path);
    model::FibreBatch batch, joined;
    joined.clear(0, 0);
    while (source->read(batch, 1)) {
        EXPECT_EQ(batch.fibreCount(), 1U);
        append(joined, batch);
    }
    EXPECT_EQ(joined.points, all.fibres.points);
    EXPECT_EQ(joined.offsets, all.fibres.offsets);
    EXPECT_EQ(source->bytesRead(), source->bytesTotal());
}

TEST(Tck, BadFilesAreRefusedWithASentence) {
    const TempFolder folder;
    const std::string good = tckBytes(tckLines(), twoTracks());
    EXPECT_EQ(failure(folder.write("a.tck", good.substr(0, good.size() - 12))),
              "a.tck: the file ends at byte 272 in fibre 2, before the infinite numbers that end it; it seems to be cut off");
    EXPECT_EQ(failure(folder.write("a.tck", good.substr(0, 40))),
              "a.tck: the file ends within its text header, before the line END");
    EXPECT_EQ(failure(folder.write("a.tck", "mrtrix image\nEND\n")),
              "a.tck: the first line is 'mrtrix image', not 'mrtrix tracks'");
    EXPECT_THAT(failure(folder.write("a.tck", tckBytes(tckLines("Int16LE"), twoTracks()))),
                testing::HasSubstr("'datatype' says 'Int16LE'; Float32LE, Float32BE, Float64LE and Float64BE are read"));
    EXPECT_THAT(failure(folder.write("a.tck", tckBytes({"mrtrix tracks", "file: other.dat 0"}, twoTracks()))),
                testing::HasSubstr("data in another file are not read"));
    EXPECT_THAT(failure(folder.write("a.tck", tckBytes({"mrtrix tracks", "file: . 3"}, twoTracks()))),
                testing::HasSubstr("places the data at byte 3, inside the header"));
    EXPECT_THAT(failure(folder.write("a.tck", tckBytes({"mrtrix tracks", "file: . 123456"}, twoTracks()))),
                testing::HasSubstr("before its data should begin at byte 123456"));
    EXPECT_THAT(failure(folder.path() / "none.tck"), testing::HasSubstr("none.tck: there is no regular file"));
    EXPECT_THAT(failure(folder.write("a.xyz", good)), testing::HasSubstr("the name ends as no tractogram's does"));
    // Any truncation is told.
    for (std::size_t size = 1; size < good.size(); size += 7) {
        EXPECT_NE(failure(folder.write("b.tck", good.substr(0, size))), "no failure") << size;
    }
}

TEST(TrackColumns, ComeFromTsfAndTextFiles) {
    const TempFolder folder;
    const auto tracks = folder.write("a.tck", tckBytes(tckLines(), twoTracks()));
    const std::vector<double> values{0.5, 0.25, 1, kNanNumber, -2, kNanNumber, kInfNumber};
    TractOptions options;
    options.columns = {
        folder.write("fa.tsf",
                     tckBytes({"mrtrix track scalars", "datatype: Float32BE", "file: . 200"}, values, "float32", true)),
        folder.write("weights.txt", "# command_history: x\n1.5 nan\n"), folder.write("nodes.csv", "3,4\n5,6 # a comment\n")};
    const Tractogram tracts = read(tracks, options);
    EXPECT_EQ(tracts.header.vertex_columns, (std::vector<model::ColumnName>{{"fa", 1}}));
    EXPECT_EQ(tracts.header.fibre_columns, (std::vector<model::ColumnName>{{"weights", 1}, {"nodes", 2}}));
    EXPECT_EQ(tracts.fibres.vertex_values[0], (std::vector<float>{0.5, 0.25, 1, -2}));
    EXPECT_EQ(tracts.fibres.fibre_values[0][0], 1.5F);
    EXPECT_TRUE(std::isnan(tracts.fibres.fibre_values[0][1]));
    EXPECT_EQ(tracts.fibres.fibre_values[1], (std::vector<float>{3, 4, 5, 6}));
}

TEST(TrackColumns, ThatDoNotBelongToTheTracksAreRefused) {
    const TempFolder folder;
    const auto tracks = folder.write("a.tck", tckBytes(tckLines(), twoTracks()));
    const auto with = [&](const std::string& name, const std::string& bytes) {
        TractOptions options;
        options.columns = {folder.write(name, bytes)};
        return failure(tracks, options);
    };
    const auto tsf = [](const std::vector<double>& values) {
        return tckBytes({"mrtrix track scalars", "datatype: Float32LE", "file: . 200"}, values);
    };
    EXPECT_EQ(with("b.txt", "1\n2\n3\n"), "b.txt: holds values of 3 fibres, and a.tck has 2");
    EXPECT_EQ(with("b.txt", "1\n"), "b.txt: holds values of 1 fibres, and a.tck has at least 2");
    EXPECT_EQ(with("b.txt", "1\ntwo\n"), "b.txt: line 2 holds 'two', which is no number");
    EXPECT_EQ(with("b.tsf", tsf({1, 2, kNanNumber, 3, kNanNumber, kInfNumber})),
              "b.tsf: holds 2 values of fibre 0, which has 3 points");
    EXPECT_THAT(with("b.tsf", tsf({1, 2, 3, kNanNumber, kInfNumber})),
                testing::HasSubstr("holds values of 1 fibres, and the tracks go on"));
    EXPECT_THAT(with("b.tsf", tsf({1, 2, 3, kNanNumber, 1, kNanNumber, 1, kNanNumber, kInfNumber})),
                testing::HasSubstr("goes on after the values of all 2 fibres"));
    EXPECT_THAT(with("b.tsf", tsf({1, 2, 3, kNanNumber, 1})), testing::HasSubstr("seems to be cut off"));
    EXPECT_THAT(with("b.nii", "x"), testing::HasSubstr("columns of a track file are read from .tsf"));
}

TEST(TckWrite, ReadsBackTheSameWithItsColumns) {
    const TempFolder folder;
    Tractogram tracts = read(folder.write("a.tck", tckBytes(tckLines(), twoTracks())));
    tracts.header.vertex_columns = {{"fa", 1}, {"rgb", 3}};
    tracts.header.fibre_columns = {{"weight", 1}};
    tracts.fibres.vertex_values = {{1, 2, 3, 4}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
    tracts.fibres.fibre_values = {{0.1F, 1e-20F}};
    const auto files = writeTractogram(*model::sourceOf(tracts), folder.path() / "out.tck");
    std::vector<std::string> names;
    for (const auto& file : files) names.push_back(file.filename().string());
    EXPECT_EQ(names, (std::vector<std::string>{"out.tck", "out_fa.tsf", "out_rgb_0.tsf", "out_rgb_1.tsf", "out_rgb_2.tsf",
                                               "out_weight.txt"}));
    TractOptions options;
    options.columns = {files[1], files[3], files[5]};
    const Tractogram back = read(files[0], options);
    EXPECT_EQ(back.fibres.points, tracts.fibres.points);
    EXPECT_EQ(back.fibres.offsets, tracts.fibres.offsets);
    EXPECT_EQ(back.fibres.vertex_values[0], tracts.fibres.vertex_values[0]);
    EXPECT_EQ(back.fibres.vertex_values[1], (std::vector<float>{1, 4, 7, 10}));
    EXPECT_EQ(back.fibres.fibre_values, tracts.fibres.fibre_values);
    EXPECT_EQ(openTck(files[0])->header().fibre_count, 2U);
}

TEST(TckWrite, LeavesNothingBehindWhenItFails) {
    const TempFolder folder;
    const auto source = openTck(folder.write("a.tck", tckBytes(tckLines(), {1, 2, 3})));
    EXPECT_THROW(writeTractogram(*source, folder.path() / "out.tck"), Error);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
    EXPECT_THROW(requireWritableName(folder.path() / "none" / "out.tck"), Error);
    EXPECT_THROW(requireWritableName(folder.path() / "out.trk"), Error);
}

}  // namespace
}  // namespace radiata::io
