// SH images: bands from the number of volumes, conventions, axes, and which voxels get a glyph.
#include "io/sh_image.h"

#include <gtest/gtest.h>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "math/sh_evaluate.h"
#include "unit/io/image_bytes.h"
#include "unit/math/sh_test_tools.h"

namespace radiata::io {
namespace {

/// A float NIfTI file of sx x 1 x 1 voxels from one coefficient vector per voxel.
test::NiftiFile shFile(const std::vector<std::vector<double>>& voxels) {
    test::NiftiFile file;
    const std::size_t count = voxels[0].size();
    file.dim = {static_cast<std::int64_t>(voxels.size()), 1, 1, static_cast<std::int64_t>(count)};
    std::vector<double> volumes;
    for (std::size_t c = 0; c < count; ++c) {
        for (const auto& voxel : voxels) volumes.push_back(voxel[c]);
    }
    file.data = test::encode(volumes, "float32", false);
    return file;
}

void setMatrix(test::NiftiFile& file, const glm::dmat3& axes) {
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) file.srow[static_cast<std::size_t>(4 * r + c)] = axes[c][r];
    }
}

double amplitude(const model::ShImage& image, std::size_t voxel, const glm::dvec3& direction) {
    const std::size_t count = image.layout.count();
    return evaluateSh(image.layout, std::span(image.coefficients).subspan(voxel * count, count), direction);
}

TEST(ShImage, TakesEveryNumberOfVolumesThatHasALayout) {
    const test::TempFolder folder;
    auto read = [&](std::size_t count, const ShOptions& options) {
        return readShImage(folder.write("a.nii", test::bytes(shFile({std::vector<double>(count, 0.5)}))), options);
    };
    for (int lmax = 0; lmax <= 16; lmax += 2) {
        const ShLayout layout{lmax, false};
        EXPECT_EQ(read(layout.count(), {}).layout, layout);
    }
    for (int lmax = 0; lmax <= 16; ++lmax) {
        const ShLayout layout{lmax, true};
        EXPECT_EQ(read(layout.count(), {.convention = {}, .axes = {}, .full = true}).layout, layout);
        if (lmax > 0) {
            EXPECT_EQ(read(layout.count(), {}).layout, layout);
        }
    }
}

TEST(ShImage, WrongNumberOfVolumesListsTheRightOnes) {
    const test::TempFolder folder;
    const auto path = folder.write("tensor.nii", test::bytes(shFile({std::vector<double>(21, 0.5)})));
    try {
        readShImage(path);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), Code::kCorrupt);
        EXPECT_STREQ(error.what(),
                     "tensor.nii: the image has 21 volumes; even bands have 1, 6, 15, 28, 45, 66, 91, 120 or 153; full bands "
                     "have 1, 4, 9, 16, 25, 36, 49, 64, 81, 100, 121, 144, 169, 196, 225, 256 or 289");
    }
    const auto even = folder.write("even.nii", test::bytes(shFile({std::vector<double>(15, 0.5)})));
    try {
        readShImage(even, {.convention = {}, .axes = {}, .full = true});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find("even bands"), std::string::npos) << "full bands were asked for";
    }
}

TEST(ShImage, ReadsEveryConventionAsTheSameFunction) {
    // Bound: 2e-6 absolute for coefficients in [-1, 1] stored as float32.
    std::mt19937 random(11);
    const test::TempFolder folder;
    for (const ShLayout layout : {ShLayout{8, false}, {5, true}}) {
        for (const ShConvention convention : {ShConvention::kDescoteaux07, ShConvention::kDescoteaux07Legacy,
                                              ShConvention::kTournier07, ShConvention::kMrtrix02}) {
            const std::vector<double> stored = test::randomCoefficients(random, layout);
            const auto path = folder.write("a.nii", test::bytes(shFile({stored})));
            const model::ShImage image = readShImage(path, {.convention = convention, .axes = {}, .full = {}});
            EXPECT_EQ(image.file_convention, convention);
            for (int i = 0; i < 20; ++i) {
                const glm::dvec3 d = test::randomDirection(random);
                EXPECT_NEAR(amplitude(image, 0, d), test::evaluateByDefinition(convention, layout, stored, d), 2e-6);
            }
        }
    }
}

TEST(ShImage, DefaultsToTournierInWorldAxesAndSaysSo) {
    const test::TempFolder folder;
    const model::ShImage image =
        readShImage(folder.write("fod.nii", test::bytes(shFile({{1, 2, 3, 4, 5, 6}, {0, 0, 0, 0, 0, 0}}))));
    EXPECT_EQ(image.file_convention, ShConvention::kTournier07);
    EXPECT_EQ(image.file_axes, ShAxes::kWorld);
    EXPECT_EQ(image.source, "fod.nii");
    EXPECT_EQ(describe(image),
              "fod.nii: 1 glyphs in 2 x 1 x 1 voxels, even bands to 2 (6 volumes), read as tournier07 with directions in world "
              "axes; 0 voxels left out for NaN or infinity");
    EXPECT_EQ(image.coefficients, (std::vector<float>{1, 6, -5, 4, 3, 2}));
}

TEST(ShImage, TurnsVoxelAxesToWorldForObliqueAndFlippedGrids) {
    // g(Q d) = f(d), Q the polar factor of the matrix: bound 1e-5 for coefficients in [-1, 1] and a float32 matrix.
    std::mt19937 random(12);
    std::normal_distribution<double> normal;
    const test::TempFolder folder;
    const ShLayout layout{8, false};
    for (int i = 0; i < 12; ++i) {
        glm::dmat3 q =
            glm::mat3_cast(glm::normalize(glm::dquat(normal(random), normal(random), normal(random), normal(random))));
        if (i < 4) q = glm::dmat3(1.0);
        if (i % 2 != 0) q[0] = -q[0];
        if (i % 4 >= 2) q[1] = -q[1];
        const std::vector<double> stored = test::randomCoefficients(random, layout);
        test::NiftiFile file = shFile({stored});
        setMatrix(file, glm::dmat3(q[0] * 1.5, q[1] * 2.0, q[2] * 3.0));
        const auto path = folder.write("a.nii", test::bytes(file));
        const model::ShImage image =
            readShImage(path, {.convention = ShConvention::kDescoteaux07Legacy, .axes = ShAxes::kVoxel, .full = {}});
        EXPECT_EQ(image.file_axes, ShAxes::kVoxel);
        for (int j = 0; j < 20; ++j) {
            const glm::dvec3 d = test::randomDirection(random);
            EXPECT_NEAR(amplitude(image, 0, q * d),
                        test::evaluateByDefinition(ShConvention::kDescoteaux07Legacy, layout, stored, d), 1e-5);
        }
        const model::ShImage world =
            readShImage(path, {.convention = ShConvention::kDescoteaux07Legacy, .axes = {}, .full = {}});
        const glm::dvec3 d = test::randomDirection(random);
        EXPECT_NEAR(amplitude(world, 0, d), test::evaluateByDefinition(ShConvention::kDescoteaux07Legacy, layout, stored, d),
                    2e-6);
    }
}

TEST(ShImage, StoresOnlyVoxelsWithAGlyphInOrder) {
    const test::TempFolder folder;
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    test::NiftiFile file;
    file.dim = {3, 2, 2, 6};
    std::vector<double> volumes(72, 0.0);
    auto at = [&](int i, int j, int k, int c) -> double& {
        return volumes[static_cast<std::size_t>(i + 3 * (j + 2 * (k + 2 * c)))];
    };
    at(2, 0, 0, 0) = 1;
    at(0, 1, 0, 5) = -1e-30;  // the smallest lobe is a lobe
    at(1, 1, 0, 0) = 1, at(1, 1, 0, 3) = nan;
    at(0, 0, 1, 2) = infinity;
    at(1, 0, 1, 0) = -infinity, at(1, 0, 1, 1) = nan;
    at(2, 0, 1, 0) = -0.0;  // zero, whatever its sign
    at(2, 1, 1, 1) = 2;
    file.data = test::encode(volumes, "float32", false);
    const model::ShImage image = readShImage(folder.write("a.nii", test::bytes(file)));
    EXPECT_EQ(image.size, glm::ivec3(3, 2, 2));
    EXPECT_EQ(image.voxels, (std::vector<glm::ivec3>{{2, 0, 0}, {0, 1, 0}, {2, 1, 1}}));
    EXPECT_EQ(image.rejected_voxels, 3U);
    ASSERT_EQ(image.coefficients.size(), 18U);
    EXPECT_EQ(image.coefficients[0], 1);
    EXPECT_EQ(image.coefficients[6 + 1], -1e-30F) << "tournier07 (2, 2) is descoteaux07 (2, -2)";
    EXPECT_EQ(image.coefficients[12 + 5], 2);
}

TEST(ShImage, DoublesBeyondFloatAreRejectedLikeInfinities) {
    const test::TempFolder folder;
    test::NiftiFile file = shFile({{1}, {2}});
    file.datatype = test::niftiDatatype("float64");
    file.data = test::encode({1e300, 2}, "float64", false);
    const model::ShImage image = readShImage(folder.write("a.nii", test::bytes(file)));
    EXPECT_EQ(image.rejected_voxels, 1U);
    EXPECT_EQ(image.coefficients, (std::vector<float>{2}));
}

TEST(ShImage, AnImageWithoutGlyphsIsAnImage) {
    const test::TempFolder folder;
    const model::ShImage image = readShImage(folder.write("a.nii", test::bytes(shFile({{0, 0, 0, 0, 0, 0}}))));
    EXPECT_TRUE(image.voxels.empty());
    EXPECT_TRUE(image.coefficients.empty());
}

TEST(ShImage, AxisOrderOfTheFileDoesNotChangeTheImage) {
    // More voxels than one block of the parallel loops; volume-contiguous against volume by volume.
    const test::TempFolder folder;
    const std::array<std::int64_t, 4> size{40, 30, 20, 15};
    auto value = [](std::int64_t x, std::int64_t y, std::int64_t z, std::int64_t v) {
        return (x + y + z) % 3 == 0 ? 0.0 : static_cast<double>((x * 7 + y * 13 + z * 29 + v * 3) % 101) - 50;
    };
    std::vector<model::ShImage> images;
    for (const std::string layout : {"+0,+1,+2,+3", "+1,+2,+3,+0", "-3,+0,-2,-1"}) {
        test::MrtrixFile file = test::mrtrixFile({40, 30, 20, 15}, layout, "Float32LE");
        file.data = test::encode(test::inLayout(size, layout, value), "float32", false);
        images.push_back(readShImage(folder.write("a.mif", test::mifBytes(file))));
    }
    ASSERT_EQ(images[0].voxels.size(), 16000U);
    for (std::size_t i = 1; i < images.size(); ++i) {
        EXPECT_EQ(images[i].voxels, images[0].voxels);
        EXPECT_EQ(images[i].coefficients, images[0].coefficients);
    }
}

}  // namespace
}  // namespace radiata::io
