// Lines of legacy .vtk files: text and binary, old and new cells, columns, axes, and files that contradict themselves.
#include "io/vtk_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/error.h"
#include "io/tractogram.h"
#include "unit/io/tract_bytes.h"

namespace radiata::io {
namespace {

using namespace test;
using model::Tractogram;

Tractogram read(const std::filesystem::path& path, VtkSpace space = VtkSpace::kAuto) {
    TractOptions options;
    options.vtk_space = space;
    return model::readAll(*openTractogram(path, options));
}

std::string failure(const std::filesystem::path& path) {
    try {
        read(path);
    } catch (const Error& error) {
        EXPECT_NE(error.code(), Code::kInternal);
        return error.what();
    }
    return "no failure";
}

TEST(VtkLines, TextAndBinaryOldAndNewAreTheSame) {
    const TempFolder folder;
    for (const std::string& bytes : {vtkText(), vtkBinary(false), vtkBinary(true)}) {
        const Tractogram tracts = read(folder.write("a.vtk", bytes));
        EXPECT_EQ(tracts.fibres.offsets, (std::vector<std::uint64_t>{0, 3, 5}));
        EXPECT_EQ(tracts.fibres.points,
                  (std::vector<glm::vec3>{{1, 2, 3}, {1.5, 2, 3}, {2, 2, 3}, {-7, 8, -9}, {-7, 8.5, -9}}));
        EXPECT_EQ(tracts.header.vertex_columns, (std::vector<model::ColumnName>{{"fa", 1}}));
        EXPECT_EQ(tracts.fibres.vertex_values[0], (std::vector<float>{0.1F, 0.2F, 0.3F, 0.4F, 0.5F}));
        EXPECT_EQ(tracts.header.fibre_columns, (std::vector<model::ColumnName>{{"id", 2}}));
        EXPECT_EQ(tracts.fibres.fibre_values[0], (std::vector<float>{1, 2, 3, 4}));
    }
}

TEST(VtkLines, AxesAreThoseOfTheTitleOrAsAskedFor) {
    const TempFolder folder;
    const auto plain = folder.write("a.vtk", vtkText());
    EXPECT_THAT(read(plain).header.remarks, testing::HasSubstr("RAS is assumed"));
    EXPECT_EQ(read(plain, VtkSpace::kLps).fibres.points.at(3), glm::vec3(7, -8, -9));
    const auto lps = folder.write("b.vtk", vtkText("3D Slicer output. SPACE=LPS"));
    EXPECT_EQ(read(lps).fibres.points.at(3), glm::vec3(7, -8, -9));
    EXPECT_EQ(read(lps).header.remarks, "");
    EXPECT_EQ(read(lps, VtkSpace::kRas).fibres.points.at(3), glm::vec3(-7, 8, -9));
}

TEST(VtkLines, LinesMayTakePointsInAnyOrderAndShareThem) {
    const TempFolder folder;
    std::string bytes = vtkText();
    bytes.replace(bytes.find("3 0 1 2\n2 3 4"), 13, "3 4 1 2\n2 1 0");
    const Tractogram tracts = read(folder.write("a.vtk", bytes));
    EXPECT_EQ(tracts.fibres.points, (std::vector<glm::vec3>{{-7, 8.5, -9}, {1.5, 2, 3}, {2, 2, 3}, {1.5, 2, 3}, {1, 2, 3}}));
    EXPECT_EQ(tracts.fibres.vertex_values[0], (std::vector<float>{0.5F, 0.2F, 0.3F, 0.2F, 0.1F}));
}

TEST(VtkLines, TheSampleFileHasItsLines) {
    const char* folder = std::getenv("RADIATA_DATA");
    if (folder == nullptr || *folder == '\0') return;
    const Tractogram tracts = read(std::filesystem::path(folder) / "formats/nv_tract.FAT_R.vtk");
    EXPECT_EQ(tracts.fibres.points.size(), 60U);
    EXPECT_EQ(tracts.fibreCount(), 5U);
    EXPECT_NEAR(tracts.fibres.points[0].x, 56.276962, 1e-5);
}

TEST(VtkLines, BadFilesAreRefusedWithASentence) {
    const TempFolder folder;
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string bytes = vtkText();
        bytes.replace(bytes.find(from), from.size(), to);
        return failure(folder.write("a.vtk", bytes));
    };
    EXPECT_THAT(with("2 3 4\n", "2 3 5\n"), testing::HasSubstr("line 1 names point 5; there are 5, counted from 0"));
    EXPECT_THAT(with("3 0 1 2", "-3 0 1 2"), testing::HasSubstr("line 0 has a count of points that is negative"));
    EXPECT_THAT(with("POLYDATA", "UNSTRUCTURED_GRID"), testing::HasSubstr("lines are read from POLYDATA only"));
    EXPECT_THAT(with("ASCII", "TEXT"), testing::HasSubstr("'TEXT' where ASCII or BINARY should be"));
    EXPECT_THAT(with("POINTS 5 float", "POINTS 5 half"), testing::HasSubstr("'half' where a number type"));
    EXPECT_THAT(with("POINTS 5", "POINTS 999999999999"), testing::HasSubstr("the header promises data up to byte"));
    EXPECT_THAT(with("# vtk DataFile", "# vtk file"), testing::HasSubstr("where '# vtk DataFile Version' should be"));
    EXPECT_THAT(with("-7 8 -9", "-7 x -9"), testing::HasSubstr("'x' in points, which is no number"));
    const std::string good = vtkBinary(true);
    const std::size_t needed = good.find("\nPOINT_DATA");
    for (std::size_t size = 1; size < needed; size += 11) {
        EXPECT_NE(failure(folder.write("b.vtk", good.substr(0, size))), "no failure") << size;
    }
}

}  // namespace
}  // namespace radiata::io
