// Real FOD images and what MRtrix3 and DIPY say about them. The folder is named by RADIATA_DATA; without it the same checks run
// on files made here, with the definition of the basis as the peer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <sstream>

#include "io/sh_image.h"
#include "math/sh_evaluate.h"
#include "support/npz.h"
#include "unit/io/image_bytes.h"
#include "unit/math/sh_test_tools.h"

namespace radiata::io {
namespace {

std::optional<std::filesystem::path> dataFolder() {
    const char* folder = std::getenv("RADIATA_DATA");
    if (folder == nullptr || *folder == '\0') return std::nullopt;
    return std::filesystem::path(folder);
}

double at(const testing::NpyArray& array, std::size_t row, std::size_t column) {
    return array.values.at(row * (array.values.size() / array.shape.at(0)) + column);
}

using VoxelIndex = std::map<std::array<int, 3>, std::size_t>;

VoxelIndex indexOf(const model::ShImage& image) {
    VoxelIndex index;
    for (std::size_t i = 0; i < image.voxels.size(); ++i) {
        index[{image.voxels[i].x, image.voxels[i].y, image.voxels[i].z}] = i;
    }
    return index;
}

std::span<const float> coefficients(const model::ShImage& image, std::size_t voxel) {
    return std::span(image.coefficients).subspan(voxel * image.layout.count(), image.layout.count());
}

/// Coefficients by where they are in the world, in micrometres: the same for every encoding of one image.
std::map<std::array<long, 3>, std::vector<float>> byPlace(const model::ShImage& image) {
    std::map<std::array<long, 3>, std::vector<float>> places;
    for (std::size_t i = 0; i < image.voxels.size(); ++i) {
        const glm::dvec3 p(image.voxel_to_world * glm::dvec4(glm::dvec3(image.voxels[i]), 1));
        const auto c = coefficients(image, i);
        places[{std::lround(p.x * 1000), std::lround(p.y * 1000), std::lround(p.z * 1000)}].assign(c.begin(), c.end());
    }
    return places;
}

std::vector<glm::dvec3> readDirections(const std::filesystem::path& path) {
    std::vector<glm::dvec3> directions;
    std::ifstream file(path);
    for (double x = 0, y = 0, z = 0; file >> x >> y >> z;) directions.push_back(glm::normalize(glm::dvec3(x, y, z)));
    return directions;
}

/// Each row of `stored` (in `convention`) is a voxel's function: equal to the image within `bound` of its largest coefficient.
void expectCoefficients(const model::ShImage& image, const testing::NpyArray& voxels, const testing::NpyArray& stored,
                        ShConvention convention, double bound) {
    const VoxelIndex index = indexOf(image);
    for (std::size_t row = 0; row < voxels.shape[0]; ++row) {
        const auto found = index.find(
            {static_cast<int>(at(voxels, row, 0)), static_cast<int>(at(voxels, row, 1)), static_cast<int>(at(voxels, row, 2))});
        ASSERT_NE(found, index.end()) << "voxel of row " << row;
        std::vector<double> expected(image.layout.count());
        for (std::size_t c = 0; c < expected.size(); ++c) expected[c] = at(stored, row, c);
        convertSh(std::span<double>(expected), image.layout, convention, ShConvention::kDescoteaux07);
        const auto read = coefficients(image, found->second);
        double largest = 0;
        for (const double value : expected) largest = std::max(largest, std::abs(value));
        for (std::size_t c = 0; c < expected.size(); ++c) {
            ASSERT_NEAR(read[c], expected[c], bound * largest) << "row " << row << " coefficient " << c;
        }
    }
}

/// Amplitudes along directions equal those of the peer to 1e-5 of the largest.
void expectAmplitudes(const model::ShImage& image, const testing::NpyArray& voxels, const testing::NpyArray& amplitudes,
                      const std::vector<glm::dvec3>& directions) {
    const VoxelIndex index = indexOf(image);
    double largest = 0;
    for (const double value : amplitudes.values) largest = std::max(largest, std::abs(value));
    double worst = 0;
    for (std::size_t row = 0; row < voxels.shape[0]; ++row) {
        const std::size_t voxel = index.at(
            {static_cast<int>(at(voxels, row, 0)), static_cast<int>(at(voxels, row, 1)), static_cast<int>(at(voxels, row, 2))});
        for (std::size_t d = 0; d < directions.size(); ++d) {
            const double ours = evaluateSh(image.layout, coefficients(image, voxel), directions[d]);
            worst = std::max(worst, std::abs(ours - at(amplitudes, row, d)));
        }
    }
    EXPECT_LT(worst, 1e-5 * largest);
    ::testing::Test::RecordProperty("worst_over_largest", std::to_string(worst / largest));
}

TEST(SampleData, SixEncodingsOfOneImageGiveEqualArrays) {
    const test::TempFolder made;
    std::vector<std::filesystem::path> files;
    if (const auto folder = dataFolder()) {
        for (const char* name :
             {"xa20_fod4.nii.gz", "xa20_fod4_LPS.nii.gz", "xa20_fod4_f64be.mif", "xa20_fod4_n2.nii", "xa20_fod4.mih"}) {
            files.push_back(*folder / "sh" / name);
        }
    }
    const std::size_t real = files.size();
    const std::array<std::int64_t, 4> size{5, 4, 3, 15};
    const auto value = [&](std::int64_t x, std::int64_t y, std::int64_t z, std::int64_t v) {
        return (x + y) % 3 == 0
                   ? 0
                   : static_cast<double>(static_cast<float>(std::sin(static_cast<double>(x + 5 * (y + 4 * (z + 3 * v))))));
    };
    const auto mirrored = [&](auto x, auto y, auto z, auto v) { return value(4 - x, 3 - y, z, v); };
    test::NiftiFile nifti;
    nifti.dim = {5, 4, 3, 15};
    nifti.srow = {1.5, 0, 0, -10, 0, 1.5, 0, 20, 0, 0, 1.5, 3};
    nifti.data = test::encode(test::inLayout(size, "+0,+1,+2,+3", value), "float32", false);
    files.push_back(made.write("a.nii.gz", test::gzip(test::bytes(nifti))));
    nifti.version = 2;
    nifti.big_endian = true;
    nifti.data = test::encode(test::inLayout(size, "+0,+1,+2,+3", value), "float32", true);
    files.push_back(made.write("b.nii", test::bytes(nifti)));
    nifti.srow = {-1.5, 0, 0, -4, 0, -1.5, 0, 24.5, 0, 0, 1.5, 3};
    nifti.data = test::encode(test::inLayout(size, "+0,+1,+2,+3", mirrored), "float32", true);
    files.push_back(made.write("c.nii", test::bytes(nifti)));
    test::MrtrixFile mrtrix = test::mrtrixFile({5, 4, 3, 15}, "-1,-2,+3,+0", "Float64BE");
    set(mrtrix, "vox", "1.5,1.5,1.5,nan");
    set(mrtrix, "transform", "1,0,0,-10,0,1,0,20,0,0,1,3");
    mrtrix.data = test::encode(test::inLayout(size, "-1,-2,+3,+0", value), "float64", true);
    files.push_back(made.write("d.mif", test::mifBytes(mrtrix)));
    files.push_back(made.write("d.mif.gz", test::gzip(test::mifBytes(mrtrix))));
    made.write("e.dat", mrtrix.data);
    files.push_back(made.write("e.mih", test::mihText(mrtrix, "e.dat")));

    for (std::size_t i = 0; i < files.size(); ++i) {
        const model::ShImage image = readShImage(files[i]);
        const auto first = byPlace(readShImage(files[i < real ? 0 : real]));
        EXPECT_EQ(image.layout, (ShLayout{4, false}));
        EXPECT_EQ(first.size(), i < real ? 268U : image.voxels.size());
        EXPECT_EQ(byPlace(image), first) << files[i].filename();
    }
}

TEST(SampleData, CoefficientsAndAmplitudesEqualThePeers) {
    // Coefficients: float32 rounding, 2^-22 of the voxel's largest (two roundings for the conventions with a factor).
    const double rounding = std::ldexp(1.0, -22);
    if (const auto folder = dataFolder()) {
        const std::vector<glm::dvec3> directions = readDirections(*folder / "refs" / "directions512.txt");
        ASSERT_EQ(directions.size(), 512U);
        for (const std::string name :
             {"xa140_fod4", "xa140_fod6", "xa140_fod8", "xa140_fod10", "xa140_fod12", "xa140_fod12_noise"}) {
            SCOPED_TRACE(name);
            const model::ShImage image = readShImage(*folder / "sh" / (name + ".nii.gz"));
            const testing::NpzFile ref(*folder / "refs" / (name + "_ref.npz"));
            const testing::NpyArray voxels = ref.array("voxel");
            ASSERT_EQ(voxels.shape[0], 256U);
            expectCoefficients(image, voxels, ref.array("coef_mrtrix"), ShConvention::kTournier07, 0);
            expectCoefficients(image, voxels, ref.array("coef_descoteaux07"), ShConvention::kDescoteaux07, rounding);
            expectCoefficients(image, voxels, ref.array("coef_descoteaux07_legacy"), ShConvention::kDescoteaux07Legacy,
                               rounding);
            expectCoefficients(image, voxels, ref.array("coef_tournier07_legacy"), ShConvention::kMrtrix02, rounding);
            expectAmplitudes(image, voxels, ref.array("amp_sh2amp"), directions);
        }
    }
    std::mt19937 random(15);
    const ShLayout layout{12, false};
    const std::vector<double> stored = test::randomCoefficients(random, layout);
    const test::TempFolder made;
    test::NiftiFile file;
    file.dim = {1, 1, 1, static_cast<std::int64_t>(layout.count())};
    file.data = test::encode(stored, "float32", false);
    const model::ShImage image = readShImage(made.write("a.nii", test::bytes(file)));
    const testing::NpyArray voxel{{1, 3}, {0, 0, 0}};
    expectCoefficients(image, voxel, {{1, layout.count()}, stored}, ShConvention::kTournier07, rounding);
    testing::NpyArray amplitudes{{1, 512}, {}};
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < 512; ++i) {
        directions.push_back(test::randomDirection(random));
        amplitudes.values.push_back(test::evaluateByDefinition(ShConvention::kTournier07, layout, stored, directions.back()));
    }
    expectAmplitudes(image, voxel, amplitudes, directions);
}

TEST(SampleData, DipysOwnImageEqualsItsReference) {
    if (const auto folder = dataFolder()) {
        const model::ShImage image = readShImage(*folder / "formats" / "dipy_ptt_fod.nii");
        const testing::NpzFile ref(*folder / "refs" / "ptt_fod_tournier07_ref.npz");
        expectCoefficients(image, ref.array("voxel"), ref.array("coef"), ShConvention::kTournier07, std::ldexp(1.0, -23));
        expectAmplitudes(image, ref.array("voxel"), ref.array("sf"), readDirections(*folder / "refs" / "directions512.txt"));
    }
    // The same kind of file, made here: dipy writes float64 coefficients volume by volume.
    const test::TempFolder made;
    std::mt19937 random(16);
    const std::vector<double> stored = test::randomCoefficients(random, {8, false});
    test::NiftiFile file;
    file.dim = {1, 1, 1, 45};
    file.datatype = test::niftiDatatype("float64");
    file.data = test::encode(stored, "float64", false);
    const model::ShImage image = readShImage(made.write("a.nii", test::bytes(file)));
    expectCoefficients(image, {{1, 3}, {0, 0, 0}}, {{1, 45}, stored}, ShConvention::kTournier07, std::ldexp(1.0, -23));
}

TEST(SampleData, WholeVolumeHasItsKnownNumberOfGlyphs) {
    if (const auto folder = dataFolder()) {
        EXPECT_EQ(readShImage(*folder / "sh" / "xa_fod8.nii.gz").voxels.size(), 41085U);
        EXPECT_EQ(readShImage(*folder / "sh" / "xadense_fod8.nii.gz").voxels.size(), 20029U);
        const auto volumes = byPlace(readShImage(*folder / "sh" / "xa140_fod8.nii.gz"));
        EXPECT_EQ(volumes.size(), 7216U);
        EXPECT_EQ(byPlace(readShImage(*folder / "sh" / "xa140_fod8_volcontig.mif.gz")), volumes);
    }
    const test::TempFolder made;
    test::NiftiFile file;
    file.dim = {30, 30, 30, 1};
    std::vector<double> values(27000);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = i % 7 == 0 ? 1 : 0;
    file.data = test::encode(values, "float32", false);
    EXPECT_EQ(readShImage(made.write("a.nii", test::bytes(file))).voxels.size(), 3858U);
}

}  // namespace
}  // namespace radiata::io
