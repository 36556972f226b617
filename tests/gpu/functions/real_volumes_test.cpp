// Samples, gradients and first hits that another program took of real volumes (folder RADIATA_DATA), by the reference and on
// the device. Without the folder volume_trace_test.cpp says the same about made volumes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "gpu/functions/function_runner.h"
#include "gpu/functions/volume_on_device.h"
#include "io/scalar_image.h"
#include "reference/scalar_field.h"
#include "shaders/test/isosurface_io.glsl"
#include "support/npz.h"

namespace radiata {
namespace {

using RealVolumes = test::FunctionTest;

glm::dvec3 row(const testing::NpyArray& array, std::size_t i) {
    return {array.values[3 * i], array.values[3 * i + 1], array.values[3 * i + 2]};
}

/// The cell of a point, and where in it the point is.
shader::GradientInput gradientInput(const shader::VolumeParams& volume, const glm::dvec3& p) {
    const glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(p)), glm::ivec3(0), volume.size - 2);
    return {volume, cell, glm::vec3(p - glm::dvec3(cell))};
}

TEST_F(RealVolumes, HaveTheSamplesGradientsAndHitsOfAnotherProgram) {
    const char* folder = std::getenv("RADIATA_DATA");
    if (folder == nullptr) return;
    struct Volume {
        const char* name;
        const char* file;
        float isovalue;
    };
    for (const Volume& v :
         {Volume{"engine", "engine_256x256x128.nii.gz", 80}, Volume{"fuel", "fuel_64x33x32.nii.gz", 60},
          Volume{"ct_head", "ct_head_headsq_quarter.nii.gz", 1150}, Volume{"t1", "t1_studyforrest_1mm.nii.gz", 8.5F},
          Volume{"mr_head", "mr_head_seg3d.nii.gz", 45}, Volume{"heptane", "heptane_302.nii.gz", 40}}) {
        const model::ScalarImage image = io::readScalarImage(std::filesystem::path(folder) / "vols" / v.file);
        const testing::NpzFile file(std::filesystem::path(folder) / "refs" / (std::string(v.name) + "_ref.npz"));
        const auto positions = file.array("sample_pos"), values = file.array("sample_value"),
                   gradients = file.array("sample_grad");
        const auto origins = file.array("ray_o"), directions = file.array("ray_d"), enters = file.array("ray_tnear"),
                   times = file.array("ray_t");
        const reference::ScalarField volume(image);
        const test::VolumeOnDevice device(this->device(), image);
        std::vector<shader::GradientInput> points;
        double largest = 1;
        for (std::size_t i = 0; i < positions.shape[0]; ++i) {
            const glm::dvec3 p = row(positions, i);
            largest = std::max(largest, std::abs(values.values[i]));
            EXPECT_NEAR(volume.value(p), values.values[i], 1e-5 * largest);
            EXPECT_LT(glm::length(volume.gradient(p) - row(gradients, i)),
                      1e-5 * largest + 2e-6 * glm::length(row(gradients, i)))
                << v.name << i;
            points.push_back(gradientInput(device.params, p));
        }
        const auto on_device = runFunction<shader::GradientOutput>("test_volume_gradient", {}, points);
        double worst_gradient = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            worst_gradient =
                std::max(worst_gradient, glm::length(glm::dvec3(on_device[i].trilinear) - row(gradients, i)) / largest);
            worst_gradient =
                std::max(worst_gradient,
                         glm::length(glm::dvec3(on_device[i].spline) - volume.splineGradient(row(positions, i))) / largest);
        }
        EXPECT_LT(worst_gradient, 2e-5) << v.name;

        std::vector<shader::VolumeRay> rays;
        for (std::size_t i = 0; i < times.values.size(); ++i) {
            // From where the ray enters the volume, so that float's step there is small.
            const glm::dvec3 start = row(origins, i) + (enters.values[i] - 1) * row(directions, i);
            rays.push_back(
                {device.params, glm::ivec3(0), glm::vec3(start), glm::vec3(row(directions, i)), v.isovalue, 0, 1e30F});
        }
        const auto hits = runFunction<shader::VolumeRayHit>("test_volume_trace", {1U}, rays);
        int compared = 0, lost = 0, invented = 0, grazing = 0;
        double worst = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const double expected = times.values[i] - enters.values[i] + 1;
            // The other program takes a ray that enters where the value is above the isovalue as hit at the volume's side.
            if (std::abs(expected - 1) < 1e-6) continue;
            const bool hit = hits[i].t < 1e30F;
            const auto own = volume.firstHit(glm::dvec3(rays[i].origin), glm::dvec3(rays[i].direction),
                                             static_cast<double>(v.isovalue), 0, 1e9);
            if (own && own->margin < 1e-3) {
                ++grazing;
                continue;
            }
            if (std::isnan(expected) || !hit) {
                lost += !std::isnan(expected) && !hit;
                invented += std::isnan(expected) && hit;
                continue;
            }
            ++compared;
            const double slope =
                std::abs(glm::dot(volume.gradient(glm::dvec3(hits[i].cell) + glm::dvec3(hits[i].at)), row(directions, i)));
            // Along the ray, where it is not grazing; else in the value.
            const double error = std::abs(static_cast<double>(hits[i].t) - expected);
            worst = std::max(worst, std::min(error, error * slope / largest));
        }
        std::printf("%s: %d hits, %d lost, %d invented, %d grazing, worst %.2g voxels; gradient %.2g\n", v.name, compared, lost,
                    invented, grazing, worst, worst_gradient);
        EXPECT_GT(compared, 400) << v.name;
        EXPECT_EQ(lost, 0) << v.name;
        EXPECT_EQ(invented, 0) << v.name;
        EXPECT_LT(worst, 1e-4) << v.name;
    }
}

}  // namespace
}  // namespace radiata
