// Tensors that other programs write give the amplitudes that those programs say: MRtrix3's dwi2tensor, and numpy arrays in
// DIPY's and FSL's order of components.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

#include "interop/programs.h"
#include "io/nifti_write.h"
#include "io/tensor_image.h"
#include "math/sh_evaluate.h"
#include "unit/io/image_bytes.h"

namespace radiata::io {
namespace {

glm::dvec3 randomDirection(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

/// Signals exp(-b x^T D x) of one D per voxel along 30 directions, on an oblique, mirrored grid; dwi2tensor must find D again.
TEST(TensorInterop, Dwi2tensorOfKnownSignalsHasTheirDiffusivities) {
    test::requireMrtrix();
    const test::TempFolder folder;
    std::mt19937 random(51);
    std::uniform_real_distribution<double> uniform(0.2, 1.5);
    Volume dwi;
    dwi.size = {4, 3, 2, 31};
    const double c = std::cos(0.4), s = std::sin(0.4);
    dwi.voxel_to_world = glm::dmat4(glm::dvec4(-2 * c, -2 * s, 0, 0), glm::dvec4(-2 * s, 2 * c, 0, 0), glm::dvec4(0, 0, 2, 0),
                                    glm::dvec4(5, 6, 7, 1));
    std::vector<glm::dmat3> tensors;
    for (int v = 0; v < 24; ++v) {
        glm::dmat3 d(0.0);
        const glm::dvec3 a = randomDirection(random), b = glm::normalize(glm::cross(a, randomDirection(random)));
        d += uniform(random) * glm::outerProduct(a, a) + 0.4 * uniform(random) * glm::outerProduct(b, b);
        d += 0.2 * glm::outerProduct(glm::cross(a, b), glm::cross(a, b));
        tensors.push_back(1e-3 * d);
    }
    dwi.data.resize(24 * 31);
    std::ofstream gradients(folder.path() / "grad.b");
    for (std::size_t g = 0; g < 31; ++g) {
        const glm::dvec3 direction = g == 0 ? glm::dvec3(0, 0, 1) : randomDirection(random);
        const double b = g == 0 ? 0 : 1000;
        gradients << direction.x << " " << direction.y << " " << direction.z << " " << b << "\n";
        for (std::size_t v = 0; v < 24; ++v) {
            dwi.data[g * 24 + v] = static_cast<float>(1000 * std::exp(-b * glm::dot(direction, tensors[v] * direction)));
        }
    }
    gradients.close();
    writeNifti(dwi, folder.path() / "dwi.nii");
    const std::string at = "'" + folder.path().string() + "/";
    test::run("dwi2tensor -quiet -grad " + at + "grad.b' " + at + "dwi.nii' " + at + "dt.mif'");
    test::run("mrconvert -quiet " + at + "dt.mif' " + at + "dt.nii.gz'");
    for (const std::string name : {"dt.mif", "dt.nii.gz"}) {
        const model::ShImage image = readTensorImage(folder.path() / name, {TensorFormat::kMrtrix, {}});
        ASSERT_EQ(image.voxels.size(), 24U);
        for (std::size_t i = 0; i < image.voxels.size(); ++i) {
            const glm::dvec3 world(image.voxel_to_world * glm::dvec4(glm::dvec3(image.voxels[i]), 1));
            const glm::ivec3 voxel(glm::round(glm::dvec3(glm::inverse(dwi.voxel_to_world) * glm::dvec4(world, 1))));
            const glm::dmat3& d = tensors[static_cast<std::size_t>(voxel.x + 4 * (voxel.y + 3 * voxel.z))];
            for (int n = 0; n < 10; ++n) {
                const glm::dvec3 x = randomDirection(random);
                const auto coefficients = std::span(image.coefficients).subspan(i * 6, 6);
                EXPECT_NEAR(evaluateSh(image.layout, coefficients, x), glm::dot(x, d * x), 2e-8) << name;
            }
        }
    }
}

TEST(TensorInterop, NumpyArraysInTheOrdersOfDipyAndFslHaveTheAmplitudesOfNumpy) {
    test::requireNibabel();
    const test::TempFolder folder;
    const std::string at = folder.path().string();
    std::ofstream(folder.path() / "make.py") << R"(
import sys
import numpy, nibabel
folder = sys.argv[1]
random = numpy.random.default_rng(4)
d = random.normal(size=(3, 2, 2, 3, 3))
d = d @ d.swapaxes(-1, -2)
affine = numpy.diag([2, 2, 2, 1.0])  # right-handed: FSL's first axis is mirrored
lower = [d[..., i, j] for i in range(3) for j in range(i + 1)]       # dipy.reconst.dti.lower_triangular
upper = [d[..., i, j] for i in range(3) for j in range(i, 3)]        # dtifit's tensor
for name, parts in (("dipy", lower), ("fsl", upper)):
    nibabel.save(nibabel.Nifti1Image(numpy.stack(parts, -1).astype("f4"), affine), f"{folder}/{name}.nii.gz")
entries = d.reshape(3, 2, 2, 9)
nibabel.save(nibabel.Nifti1Image(entries.astype("f4"), affine), f"{folder}/entries.nii.gz")
x = random.normal(size=(20, 3))
x /= numpy.linalg.norm(x, axis=1)[:, None]
amplitudes = numpy.einsum("zyxij,di,dj->zyxd", d.transpose(2, 1, 0, 3, 4), x, x)
numpy.savetxt(f"{folder}/x.txt", x)
numpy.savetxt(f"{folder}/amplitudes.txt", amplitudes.reshape(12, 20))
)";
    test::run("/usr/bin/python3 '" + at + "/make.py' '" + at + "'");
    std::vector<double> x(60), amplitudes(240);
    std::ifstream directions(folder.path() / "x.txt"), values(folder.path() / "amplitudes.txt");
    for (double& value : x) directions >> value;
    for (double& value : amplitudes) values >> value;
    const std::vector<std::pair<std::string, TensorFormat>> files{
        {"dipy", TensorFormat::kDipy}, {"fsl", TensorFormat::kFsl}, {"entries", TensorFormat::kEntries}};
    for (const auto& [name, format] : files) {
        const model::ShImage image = readTensorImage(folder.path() / (name + ".nii.gz"), {format, {}});
        ASSERT_EQ(image.voxels.size(), 12U);
        for (std::size_t v = 0; v < 12; ++v) {
            for (std::size_t n = 0; n < 20; ++n) {
                glm::dvec3 direction(x[3 * n], x[3 * n + 1], x[3 * n + 2]);
                if (format == TensorFormat::kFsl) direction.x = -direction.x;
                const auto coefficients = std::span(image.coefficients).subspan(v * 6, 6);
                EXPECT_NEAR(evaluateSh(image.layout, coefficients, direction), amplitudes[20 * v + n], 1e-5) << name;
            }
        }
    }
}

}  // namespace
}  // namespace radiata::io
