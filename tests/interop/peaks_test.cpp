// Peaks against sh2peaks of MRtrix3, on generated fibre functions and, if RADIATA_DATA is there, on measured ones.
#include "build/peaks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <random>

#include "interop/programs.h"
#include "io/nifti_write.h"
#include "io/sh_image.h"
#include "math/sh_evaluate.h"

#include "unit/io/image_bytes.h"

namespace radiata::io {
namespace {

constexpr int kPeaks = 5;

double angleDeg(const glm::dvec3& a, const glm::dvec3& b) {
    const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    return glm::degrees(std::min(angle, std::numbers::pi - angle));
}

struct Comparison {
    int voxels = 0, peaks = 0;
    int unsettled = 0;    ///< of sh2peaks, that are no maximum: the slope there is more than float explains
    int lost = 0;         ///< of sh2peaks, that ours lack
    int larger_lost = 0;  ///< of ours, larger than one that sh2peaks gives and not among its own
    double worst_deg = 0, worst_amplitude = 0;
};

/// Whether sh2peaks' Newton search came to rest on a maximum: the next Newton step from there is below 0.05 degrees.
bool settled(const ShDerivatives& f, const glm::dvec3& direction) {
    const SphereDerivatives d = f(direction);
    const double determinant = d.curvature[0][0] * d.curvature[1][1] - d.curvature[0][1] * d.curvature[0][1];
    if (!(d.curvature[0][0] < 0 && determinant > 0)) return false;
    const double a = (d.curvature[1][1] * d.slope[0] - d.curvature[0][1] * d.slope[1]) / determinant;
    const double b = (d.curvature[0][0] * d.slope[1] - d.curvature[0][1] * d.slope[0]) / determinant;
    return std::hypot(a, b) < glm::radians(0.05);
}

Comparison compare(const std::filesystem::path& file, const std::filesystem::path& peaks_file, std::size_t stride) {
    test::run("sh2peaks -quiet -force -num " + std::to_string(kPeaks) + " " + file.string() + " " + peaks_file.string());
    const model::ShImage image = readShImage(file);
    const Volume theirs = readVolume(peaks_file);
    const auto volume_size = static_cast<std::size_t>(theirs.size[0] * theirs.size[1] * theirs.size[2]);
    // The two files may store their axes in other directions.
    const glm::dmat4 map = glm::inverse(theirs.voxel_to_world) * image.voxel_to_world;
    Comparison result;
    for (std::size_t slot = 0; slot < image.voxels.size(); slot += stride) {
        const glm::ivec3 voxel(glm::round(glm::dvec3(map * glm::dvec4(glm::dvec3(image.voxels[slot]), 1.0))));
        const auto at = static_cast<std::size_t>(voxel.x + theirs.size[0] * (voxel.y + theirs.size[1] * voxel.z));
        const auto coefficients = std::span(image.coefficients).subspan(slot * image.layout.count(), image.layout.count());
        const std::vector<model::Peak> ours = PeakFinder(image.layout, coefficients).peaks();
        const ShDerivatives f(image.layout, std::vector<double>(coefficients.begin(), coefficients.end()));
        ++result.voxels;
        double smallest = 1e30;
        std::vector<glm::dvec3> known;
        for (int p = 0; p < kPeaks; ++p) {
            const auto value = [&](int axis) {
                return static_cast<double>(theirs.data[at + volume_size * static_cast<std::size_t>(3 * p + axis)]);
            };
            const glm::dvec3 peak(value(0), value(1), value(2));
            const double amplitude = glm::length(peak);
            if (!std::isfinite(amplitude) || amplitude == 0) continue;
            const glm::dvec3 direction = peak / amplitude;
            // Peaks below 0 are written with their direction turned round; ours are above 0.
            if (!(f(direction).value > 0)) continue;
            if (!settled(f, direction)) {
                ++result.unsettled;
                continue;
            }
            ++result.peaks;
            known.push_back(direction);
            smallest = std::min(smallest, amplitude);
            const auto nearest = std::ranges::min_element(
                ours, {}, [&](const model::Peak& other) { return angleDeg(other.direction, direction); });
            if (nearest == ours.end() || angleDeg(nearest->direction, direction) > 1) {
                ++result.lost;
                continue;
            }
            result.worst_deg = std::max(result.worst_deg, angleDeg(nearest->direction, direction));
            result.worst_amplitude =
                std::max(result.worst_amplitude, std::abs(nearest->amplitude - amplitude) / ours[0].amplitude);
        }
        for (const model::Peak& peak : ours) {
            if (known.size() < kPeaks || peak.amplitude <= smallest * 1.001) break;
            const bool there = std::ranges::any_of(
                known, [&](const glm::dvec3& direction) { return angleDeg(direction, peak.direction) < 1; });
            if (!there) ++result.larger_lost;
        }
    }
    return result;
}

void expectEqual(const Comparison& result, const char* what) {
    std::printf(
        "%s: %d voxels, %d peaks of sh2peaks, worst angle %.3g degrees, worst amplitude %.2g of the largest; %d of its "
        "searches not at a maximum; %d peaks of ours larger than its smallest that it has not\n",
        what, result.voxels, result.peaks, result.worst_deg, result.worst_amplitude, result.unsettled, result.larger_lost);
    EXPECT_EQ(result.lost, 0);
    EXPECT_LT(result.worst_deg, 0.1);
    EXPECT_LT(result.worst_amplitude, 1e-3);
    EXPECT_LT(result.unsettled, result.peaks / 20 + 1);
}

TEST(PeaksInterop, EqualSh2peaksWhereItConverges) {
    test::requireMrtrix();
    const test::TempFolder folder;
    std::mt19937 random(12);
    std::normal_distribution<double> normal;
    for (const int lmax : {4, 8, 12}) {
        // Two or three lobes cos^16 each, in every voxel.
        const ShLayout layout{lmax, false};
        Volume volume;
        volume.size = {6, 4, 1, static_cast<std::int64_t>(layout.count())};
        volume.voxel_to_world = glm::dmat4(1.0);
        volume.data.assign(24 * layout.count(), 0.0F);
        std::vector<double> basis(layout.count());
        for (std::size_t v = 0; v < 24; ++v) {
            std::vector<double> tournier(layout.count(), 0.0);
            for (int lobe = 0; lobe < 2 + static_cast<int>(v % 2); ++lobe) {
                const glm::dvec3 axis = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
                evaluateSh(layout, axis, basis);
                for (int l = 0; l <= lmax; l += 2) {
                    const double weight = std::exp(-0.02 * l * (l + 1)) * (1.0 - 0.25 * lobe);
                    for (int m = -l; m <= l; ++m) tournier[layout.index(l, m)] += weight * basis[layout.index(l, m)];
                }
            }
            convertSh(std::span<double>(tournier), layout, ShConvention::kDescoteaux07, ShConvention::kTournier07);
            for (std::size_t c = 0; c < layout.count(); ++c) volume.data[v + 24 * c] = static_cast<float>(tournier[c]);
        }
        writeNifti(volume, folder.path() / "fod.nii");
        expectEqual(compare(folder.path() / "fod.nii", folder.path() / "peaks.nii", 1),
                    ("generated, lmax " + std::to_string(lmax)).c_str());
    }
    const char* data = std::getenv("RADIATA_DATA");
    if (data == nullptr || *data == 0) return;
    expectEqual(compare(std::filesystem::path(data) / "sh" / "xa140_fod8.nii.gz", folder.path() / "peaks.nii", 45),
                "xa140_fod8");
}

}  // namespace
}  // namespace radiata::io
