#include "build/phantom.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/checked.h"
#include "base/error.h"
#include "base/parallel.h"
#include "build/phantom_lobe.h"
#include "build/phantom_random.h"
#include "build/phantom_tissue.h"

namespace radiata {
namespace {

using phantom::Tissue;

constexpr int kSizeMax = 1024;
constexpr std::uint64_t kSliceGlyphsMax = 1'000'000;
constexpr double kSliceHeightMm = 32;    // through the crossings of the centrum semiovale
constexpr double kIsotropicGrey = 0.12;  // fractions of the volume
constexpr double kIsotropicWhite = 0.06;
constexpr double kIsotropicFluid = 0.02;
constexpr double kRadialCortex = 0.3;
constexpr double kRadialWhite = 0.3;  // where no named bundle runs
constexpr double kLabelFraction = 0.1;

[[noreturn]] void refuse(const std::string& what, const std::string& value, const std::string& right) {
    throw Error(Code::kInvalidArgument, "phantom: " + what + " is " + value + "; " + right);
}

void validate(const PhantomOptions& options) {
    if (options.lmax < 0 || options.lmax > kLmaxLimit || options.lmax % 2 != 0) {
        refuse("lmax", std::to_string(options.lmax), "an even number from 0 to 16 would be right");
    }
    if (options.size < 1 || options.size > kSizeMax) {
        refuse("size", std::to_string(options.size), "1 to " + std::to_string(kSizeMax) + " voxels would be right");
    }
    if (options.voxel_mm && !(*options.voxel_mm >= 0.1 && *options.voxel_mm <= 200)) {
        refuse("voxel", std::to_string(*options.voxel_mm), "0.1 to 200 mm would be right");
    }
    if (!(options.noise >= 0 && options.noise <= 1)) {
        refuse("noise", std::to_string(options.noise), "0 to 1 would be right");
    }
    if (options.slice_glyphs > kSliceGlyphsMax) {
        refuse("number of glyphs in the slice", std::to_string(options.slice_glyphs),
               "at most " + std::to_string(kSliceGlyphsMax) + " would be right");
    }
}

glm::dvec3 headMin() { return {phantom::kHeadMin[0], phantom::kHeadMin[1], phantom::kHeadMin[2]}; }
glm::dvec3 headMax() { return {phantom::kHeadMax[0], phantom::kHeadMax[1], phantom::kHeadMax[2]}; }

/// Cubic voxels in world axes, centred on the head.
PhantomGrid gridOfVoxel(double voxel_mm) {
    PhantomGrid grid;
    const glm::dvec3 extent = headMax() - headMin();
    grid.size = glm::max(glm::ivec3(glm::ceil(extent / voxel_mm - 1e-9)), glm::ivec3(1));
    const glm::dvec3 first = 0.5 * (headMin() + headMax()) - 0.5 * voxel_mm * glm::dvec3(grid.size - 1);
    for (int axis = 0; axis < 3; ++axis) grid.voxel_to_world[axis][axis] = voxel_mm;
    grid.voxel_to_world[3] = glm::dvec4(first, 1.0);
    return grid;
}

PhantomGrid sliceOfVoxel(double voxel_mm) {
    PhantomGrid grid = gridOfVoxel(voxel_mm);
    grid.size.z = 1;
    grid.voxel_to_world[3].z = kSliceHeightMm;
    return grid;
}

/// Voxels of each row (fixed j and k) that lie in the head.
std::vector<std::uint64_t> countRows(const PhantomGrid& grid, std::uint64_t seed) {
    std::vector<std::uint64_t> rows(static_cast<std::size_t>(grid.size.y) * grid.size.z, 0);
    parallelFor(rows.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            const int j = static_cast<int>(row) % grid.size.y, k = static_cast<int>(row) / grid.size.y;
            for (int i = 0; i < grid.size.x; ++i) {
                if (phantom::tissueAt(grid.voxelCentre({i, j, k}), seed).tissue != Tissue::kOutside) ++rows[row];
            }
        }
    });
    return rows;
}

std::uint64_t sum(const std::vector<std::uint64_t>& rows) {
    std::uint64_t total = 0;
    for (std::uint64_t row : rows) total += row;
    return total;
}

PhantomGrid gridOf(const PhantomOptions& options) {
    const double longest = headMax().y - headMin().y;
    if (options.slice_glyphs > 0) {
        // The voxels' number grows with 1 / edge^2 but for the border, so a few steps suffice.
        double voxel_mm = std::min(40.0, std::sqrt(16000.0 / static_cast<double>(options.slice_glyphs)));
        while (sum(countRows(sliceOfVoxel(voxel_mm), options.seed)) < options.slice_glyphs) voxel_mm *= 0.98;
        return sliceOfVoxel(voxel_mm);
    }
    return gridOfVoxel(options.voxel_mm.value_or(longest / options.size));
}

/// The density at a point, without noise.
void addDensity(const phantom::Lobe& lobe, const phantom::TissueSample& tissue, const phantom::FieldSample& fibres,
                std::span<double> coefficients, std::span<double> basis) {
    const double isotropic = tissue.tissue == Tissue::kFluid  ? kIsotropicFluid
                             : tissue.tissue == Tissue::kGrey ? kIsotropicGrey
                                                              : kIsotropicWhite;
    coefficients[0] += isotropic * std::sqrt(0.25 / std::numbers::pi);
    if (tissue.tissue == Tissue::kFluid) return;
    const double free = 1 - std::min(1.0, fibres.total());
    const double radial = free * free * glm::mix(kRadialWhite, kRadialCortex, tissue.cortex);
    lobe.add(tissue.outward, radial, coefficients, basis);
    for (std::size_t b = 0; b < fibres.count; ++b) {
        lobe.add(fibres.bundles[b].tangent, fibres.bundles[b].fraction, coefficients, basis);
    }
}

}  // namespace

Phantom::Phantom(const PhantomOptions& options)
    : options_((validate(options), options)), grid_(gridOf(options)), field_(phantom::bundles(options.seed)) {
    const std::uint64_t voxels =
        checkedMultiply(checkedMultiply(grid_.size.x, grid_.size.y, "phantom"), grid_.size.z, "phantom");
    const std::uint64_t bytes = checkedMultiply(voxels, ShLayout{options.lmax, false}.count() * sizeof(float), "phantom");
    if (bytes > options.bytes_max) {
        throw Error(Code::kResourceExhausted,
                    "phantom: " + std::to_string(grid_.size.x) + " x " + std::to_string(grid_.size.y) + " x " +
                        std::to_string(grid_.size.z) + " voxels with lmax " + std::to_string(options.lmax) + " take " +
                        std::to_string(bytes >> 20) + " MiB; a smaller size or lmax would fit the limit of " +
                        std::to_string(options.bytes_max >> 20) + " MiB");
    }
}

model::ShImage Phantom::shImage() const {
    const phantom::Lobe lobe({options_.lmax, false});
    const std::size_t count = lobe.layout().count();
    const std::vector<std::uint64_t> rows = countRows(grid_, options_.seed);
    std::vector<std::uint64_t> first(rows.size() + 1, 0);
    for (std::size_t row = 0; row < rows.size(); ++row) first[row + 1] = first[row] + rows[row];
    model::ShImage image;
    image.size = grid_.size;
    image.voxel_to_world = grid_.voxel_to_world;
    image.layout = lobe.layout();
    image.file_convention = ShConvention::kDescoteaux07;
    image.source = "phantom";
    image.voxels.resize(first.back());
    image.coefficients.resize(checkedMultiply(first.back(), count, "phantom coefficients"));
    parallelFor(rows.size(), 4, [&](std::size_t begin, std::size_t end) {
        std::vector<double> coefficients(count), basis(count);
        for (std::size_t row = begin; row < end; ++row) {
            const int j = static_cast<int>(row) % grid_.size.y, k = static_cast<int>(row) / grid_.size.y;
            std::size_t v = first[row];
            for (int i = 0; i < grid_.size.x; ++i) {
                const glm::dvec3 p = grid_.voxelCentre({i, j, k});
                const phantom::TissueSample tissue = phantom::tissueAt(p, options_.seed);
                if (tissue.tissue == Tissue::kOutside) continue;
                std::fill(coefficients.begin(), coefficients.end(), 0.0);
                addDensity(lobe, tissue, field_.sample(p), coefficients, basis);
                image.voxels[v] = {i, j, k};
                for (std::size_t c = 0; c < count; ++c) {
                    const double noise = options_.noise > 0 ? phantom::gaussian(options_.seed + 1, v * count + c) : 0.0;
                    image.coefficients[v * count + c] = static_cast<float>(coefficients[c] + options_.noise * noise);
                }
                ++v;
            }
        }
    });
    return image;
}

std::vector<std::uint8_t> Phantom::labels() const {
    std::vector<std::uint8_t> labels(static_cast<std::size_t>(grid_.size.x) * grid_.size.y * grid_.size.z, phantom::kNoBundle);
    const std::size_t row_count = static_cast<std::size_t>(grid_.size.y) * grid_.size.z;
    parallelFor(row_count, 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            const int j = static_cast<int>(row) % grid_.size.y, k = static_cast<int>(row) / grid_.size.y;
            for (int i = 0; i < grid_.size.x; ++i) {
                const glm::dvec3 p = grid_.voxelCentre({i, j, k});
                const Tissue tissue = phantom::tissueAt(p, options_.seed).tissue;
                if (tissue == Tissue::kOutside || tissue == Tissue::kFluid) continue;
                const phantom::FieldSample fibres = field_.sample(p);
                double strongest = kLabelFraction;
                for (std::size_t b = 0; b < fibres.count; ++b) {
                    if (fibres.bundles[b].fraction < strongest) continue;
                    strongest = fibres.bundles[b].fraction;
                    labels[row * grid_.size.x + i] = static_cast<std::uint8_t>(fibres.bundles[b].id);
                }
            }
        }
    });
    return labels;
}

model::ShImage phantomShImage(const PhantomOptions& options) { return Phantom(options).shImage(); }

}  // namespace radiata
