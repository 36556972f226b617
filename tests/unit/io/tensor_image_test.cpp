// Tensor images: component orders, axes, headers that disagree with their samples.
#include "io/tensor_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "base/error.h"
#include "math/cartesian_tensor.h"
#include "math/sh_evaluate.h"
#include "unit/io/image_bytes.h"
#include "unit/math/sh_test_tools.h"

namespace radiata::io {
namespace {

/// One tensor per voxel along x, as volumes of doubles.
std::string volumes(const std::vector<std::vector<double>>& voxels, const std::string& type = "float32") {
    std::vector<double> values;
    for (std::size_t c = 0; c < voxels[0].size(); ++c) {
        for (const auto& voxel : voxels) values.push_back(voxel[c]);
    }
    return test::encode(values, type, false);
}

test::NiftiFile nifti(const std::vector<std::vector<double>>& voxels) {
    test::NiftiFile file;
    file.dim = {static_cast<std::int64_t>(voxels.size()), 1, 1, static_cast<std::int64_t>(voxels[0].size())};
    file.data = volumes(voxels);
    return file;
}

test::MrtrixFile mrtrix(const std::vector<std::vector<double>>& voxels, int order, const std::string& components) {
    test::MrtrixFile file =
        test::mrtrixFile({static_cast<std::int64_t>(voxels.size()), 1, 1, static_cast<std::int64_t>(voxels[0].size())},
                         "+0,+1,+2,+3", "Float32LE");
    test::set(file, "tensor_order", std::to_string(order));
    test::set(file, "tensor_components", components);
    file.data = volumes(voxels);
    return file;
}

double amplitude(const model::ShImage& image, std::size_t voxel, const glm::dvec3& direction) {
    const std::size_t count = image.layout.count();
    return evaluateSh(image.layout, std::span(image.coefficients).subspan(voxel * count, count), direction);
}

double ownAmplitude(const model::ShImage& image, std::size_t voxel, const glm::dvec3& direction) {
    const std::size_t stride = symmetricCount(image.tensor_order);
    const auto first = image.tensors.begin() + static_cast<std::ptrdiff_t>(voxel * stride);
    return evaluateTensor(image.tensor_order, std::vector<double>(first, first + static_cast<std::ptrdiff_t>(stride)),
                          direction);
}

/// The sentence and code with which reading fails.
void refused(const std::function<void()>& read, Code code, const std::string& words) {
    try {
        read();
        ADD_FAILURE() << "read, should have said: " << words;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code) << error.what();
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

/// x^T D x of D = (xx 1, xy 0.1, xz 0.2, yy 2, yz 0.3, zz 3)
double quadratic(const glm::dvec3& x) {
    return x.x * x.x + 2 * x.y * x.y + 3 * x.z * x.z + 2 * (0.1 * x.x * x.y + 0.2 * x.x * x.z + 0.3 * x.y * x.z);
}

TEST(TensorImage, SixVolumesInTheOrdersOfMrtrixDipyAndFsl) {
    const test::TempFolder folder;
    const std::vector<std::pair<TensorFormat, std::vector<double>>> formats{
        {TensorFormat::kMrtrix, {1, 2, 3, 0.1, 0.2, 0.3}},
        {TensorFormat::kDipy, {1, 0.1, 2, 0.2, 0.3, 3}},
        {TensorFormat::kFsl, {1, 0.1, 0.2, 2, 0.3, 3}},
        {TensorFormat::kSymmetric, {1, 0.1, 0.2, 2, 0.3, 3}},
        {TensorFormat::kEntries, {1, 0.1, 0.2, 0.1, 2, 0.3, 0.2, 0.3, 3}},
        // Without symmetry: the mean of both sides counts.
        {TensorFormat::kEntries, {1, 0.5, 0.2, -0.3, 2, 0.6, 0.2, 0, 3}},
    };
    std::mt19937 random(6);
    for (const auto& [format, values] : formats) {
        const auto path = folder.write("t.nii", test::bytes(nifti({values, std::vector<double>(values.size(), 0.0), values})));
        const model::ShImage image = readTensorImage(path, {format, ShAxes::kWorld});
        EXPECT_EQ(image.tensor_order, 2);
        EXPECT_EQ(image.layout, (ShLayout{2, false}));
        EXPECT_EQ(image.tensor_format, name(format));
        ASSERT_EQ(image.voxels.size(), 2U);
        EXPECT_EQ(image.voxels[1], glm::ivec3(2, 0, 0));
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 x = test::randomDirection(random);
            EXPECT_NEAR(amplitude(image, 1, x), quadratic(x), 1e-6);
            EXPECT_NEAR(ownAmplitude(image, 0, x), quadratic(x), 1e-6);
        }
    }
}

TEST(TensorImage, AxesAreThoseOfTheFormat) {
    const test::TempFolder folder;
    std::mt19937 random(7);
    for (const bool right_handed : {true, false}) {
        // A grid turned by 90 degrees about z: voxel x is world y, voxel y is world -x; mirrored in x if left-handed.
        const double sign = right_handed ? 1 : -1;
        test::NiftiFile dipy = nifti({{1, 0.1, 2, 0.2, 0.3, 3}});
        dipy.srow = {0, -2, 0, 0, 2 * sign, 0, 0, 0, 0, 0, 2, 0};
        test::NiftiFile fsl = nifti({{1, 0.1, 0.2, 2, 0.3, 3}});
        fsl.srow = dipy.srow;
        const model::ShImage voxel = readTensorImage(folder.write("d.nii", test::bytes(dipy)), {TensorFormat::kDipy, {}});
        const model::ShImage mirrored = readTensorImage(folder.write("f.nii", test::bytes(fsl)), {TensorFormat::kFsl, {}});
        const model::ShImage told =
            readTensorImage(folder.write("f.nii", test::bytes(fsl)), {TensorFormat::kFsl, ShAxes::kVoxel});
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 v = test::randomDirection(random);  // in voxel axes
            const glm::dvec3 world(-v.y, sign * v.x, v.z);
            EXPECT_NEAR(amplitude(voxel, 0, world), quadratic(v), 1e-6);
            EXPECT_NEAR(ownAmplitude(voxel, 0, world), quadratic(v), 1e-6);
            EXPECT_NEAR(amplitude(told, 0, world), quadratic(v), 1e-6);
            EXPECT_NEAR(amplitude(mirrored, 0, world), quadratic(right_handed ? glm::dvec3(-v.x, v.y, v.z) : v), 1e-6);
        }
    }
}

TEST(TensorImage, StiffnessGlyphIsTheDirectContraction) {
    // T(x, x, x, x) summed over all 81 entries of a stiffness tensor, in 21 volumes, 36 volumes and 81 entries: to 1e-6.
    const test::TempFolder folder;
    std::mt19937 random(8);
    std::uniform_real_distribution<double> uniform(-0.2, 1);
    std::vector<double> upper(21), matrix(36), entries;
    for (double& value : upper) value = static_cast<double>(static_cast<float>(uniform(random)));
    std::size_t next = 0;
    for (std::size_t row = 0; row < 6; ++row) {
        for (std::size_t column = row; column < 6; ++column)
            matrix[6 * row + column] = matrix[6 * column + row] = upper[next++];
    }
    constexpr std::size_t kPair[9] = {0, 5, 4, 5, 1, 3, 4, 3, 2};
    for (std::size_t ij = 0; ij < 9; ++ij) {
        for (std::size_t kl = 0; kl < 9; ++kl) entries.push_back(matrix[6 * kPair[ij] + kPair[kl]]);
    }
    const std::vector<std::pair<TensorFormat, std::vector<double>>> files{
        {TensorFormat::kVoigtStiffness, upper}, {TensorFormat::kVoigtStiffness, matrix}, {TensorFormat::kEntries, entries}};
    for (const auto& [format, values] : files) {
        const model::ShImage image = readTensorImage(folder.write("c.nii", test::bytes(nifti({values}))), {format, {}});
        EXPECT_EQ(image.layout, (ShLayout{4, false}));
        double worst = 0;
        for (int n = 0; n < 1000; ++n) {
            const glm::dvec3 x = test::randomDirection(random);
            double direct = 0;
            for (std::size_t e = 0; e < 81; ++e) {
                direct += entries[e] * x[static_cast<int>(e / 27)] * x[static_cast<int>(e / 9 % 3)] *
                          x[static_cast<int>(e / 3 % 3)] * x[static_cast<int>(e % 3)];
            }
            worst = std::max({worst, std::abs(amplitude(image, 0, x) - direct), std::abs(ownAmplitude(image, 0, x) - direct)});
        }
        EXPECT_LT(worst, 1e-6);
    }
}

TEST(TensorImage, EveryOrderIsReadFromItsOwnHeader) {
    const test::TempFolder folder;
    std::mt19937 random(9);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int order = 2; order <= 12; ++order) {
        std::vector<double> components(symmetricCount(order));
        for (double& value : components) value = static_cast<double>(static_cast<float>(uniform(random)));
        test::MrtrixFile file = mrtrix({components}, order, "symmetric");
        if (order % 2 == 0) test::set(file, "tensor_trace", std::to_string(fullTrace(order, components)));
        const auto path = folder.write("t.mif", test::mifBytes(file));
        EXPECT_TRUE(namesTensors(path));
        const model::ShImage image = readTensorImage(path);
        EXPECT_EQ(image.tensor_order, order);
        EXPECT_EQ(image.layout, (ShLayout{order, order % 2 != 0}));
        EXPECT_EQ(readTensorHeader(path).tensor_order, order);
        double size = 0, worst = 0;
        for (int n = 0; n < 50; ++n) {
            const glm::dvec3 x = test::randomDirection(random);
            const double expected = evaluateTensor(order, components, x);
            size = std::max(size, std::abs(expected));
            worst =
                std::max({worst, std::abs(amplitude(image, 0, x) - expected), std::abs(ownAmplitude(image, 0, x) - expected)});
        }
        EXPECT_LT(worst, 1e-6 * std::max(size, 1.0)) << order;
    }
}

TEST(TensorImage, HeadersThatDisagreeAreRefusedInOneSentence) {
    const test::TempFolder folder;
    const std::vector<double> six{1, 0.1, 0.2, 2, 0.3, 3};
    const auto read = [&](const test::MrtrixFile& file, const TensorOptions& options = {}) {
        return [&folder, file, options] { readTensorImage(folder.write("t.mif", test::mifBytes(file)), options); };
    };
    test::MrtrixFile file = mrtrix({six, six}, 4, "symmetric");
    refused(read(file), Code::kCorrupt,
            "t.mif: the image has 6 volumes; tensor_order 4 with tensor_components symmetric needs 15");
    file = mrtrix({six, six}, 14, "symmetric");
    refused(read(file), Code::kUnsupported, "tensor_order is 14; tensors of order 2 to 12 are read");
    file = mrtrix({six, six}, 2, "half");
    refused(read(file), Code::kCorrupt, "tensor_components is 'half'");
    file = mrtrix({six, six}, 2, "symmetric");
    test::set(file, "tensor_trace", "12");
    EXPECT_NO_THROW(read(file)());
    test::set(file, "tensor_trace", "11.9");
    refused(read(file), Code::kCorrupt, "the tensors' traces add up to 12, the header's tensor_trace is 11.9");
    test::set(file, "tensor_trace", "nan");
    refused(read(file), Code::kCorrupt, "it must be one finite number");
    file = mrtrix({std::vector<double>(10, 1.0)}, 3, "symmetric");
    test::set(file, "tensor_trace", "3");
    refused(read(file), Code::kCorrupt, "only even orders have a full trace");
    file = mrtrix({six}, 2, "symmetric");
    refused(read(file, {TensorFormat::kDipy, {}}), Code::kInvalidArgument, "the header says that the volumes are 'symmetric'");
}

TEST(TensorImage, WrongNumbersOfVolumesAreRefused) {
    const test::TempFolder folder;
    const auto read = [&](std::size_t count, const TensorOptions& options) {
        return [&folder, count, options] {
            readTensorImage(folder.write("t.nii", test::bytes(nifti({std::vector<double>(count, 0.5)}))), options);
        };
    };
    refused(read(7, {TensorFormat::kMrtrix, {}}), Code::kCorrupt, "t.nii: the image has 7 volumes; mrtrix tensors have 6");
    refused(read(15, {TensorFormat::kMandel, {}}), Code::kCorrupt, "mandel tensors have 21 (upper triangle) or 36");
    refused(read(105, {TensorFormat::kSymmetric, {}}), Code::kCorrupt, "6, 10, 15, 21, 28, 36, 45, 55, 66, 78 or 91");
    refused(read(10, {TensorFormat::kEntries, {}}), Code::kCorrupt, "9, 27, 81, 243");
    refused(read(6, {}), Code::kInvalidArgument, "nothing says which volume is which component");
    EXPECT_THROW(tensorFormatFromName("camino"), Error);
    EXPECT_EQ(tensorFormatFromName("voigt-compliance"), TensorFormat::kVoigtCompliance);
}

TEST(TensorImage, VoxelsThatAreNotFiniteAreLeftOutAndHugeOnesRefused) {
    const test::TempFolder folder;
    const std::vector<double> six{1, 0.1, 0.2, 2, 0.3, 3};
    std::vector<double> bad = six;
    bad[4] = std::nan("");
    const model::ShImage image =
        readTensorImage(folder.write("t.nii", test::bytes(nifti({bad, six}))), {TensorFormat::kMrtrix, {}});
    EXPECT_EQ(image.rejected_voxels, 1U);
    EXPECT_EQ(image.voxels.size(), 1U);
    const auto huge = folder.write("h.nii", test::bytes(nifti({std::vector<double>(6, 3e38)})));
    refused([&] { readTensorImage(huge, {TensorFormat::kMrtrix, {}}); }, Code::kCorrupt, "range of 32-bit floats");
}

}  // namespace
}  // namespace radiata::io
