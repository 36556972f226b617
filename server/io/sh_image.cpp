#include "io/sh_image.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/parallel.h"
#include "io/glyph_voxels.h"
#include "io/stored_image.h"
#include "math/polar.h"
#include "math/sh_rotation.h"

namespace radiata::io {
namespace {

std::string countsText(bool full) {
    std::string text;
    for (int lmax = 0; lmax <= kLmaxLimit; lmax += full ? 1 : 2) {
        text += (lmax == 0 ? "" : lmax == kLmaxLimit ? " or " : ", ") + std::to_string(ShLayout{lmax, full}.count());
    }
    return text;
}

ShLayout layoutOf(const StoredImage& image, const ShOptions& options, const std::string& file) {
    const auto layout = shLayoutOfCount(static_cast<std::size_t>(image.size[3]), options.full);
    if (layout) return *layout;
    std::string right;
    if (!options.full.value_or(false)) right += "even bands have " + countsText(false);
    if (options.full.value_or(true)) right += (right.empty() ? "" : "; ") + ("full bands have " + countsText(true));
    throw Error(Code::kCorrupt, file + ": the image has " + std::to_string(image.size[3]) + " volumes; " + right);
}

/// Takes the coefficients of each glyph together, converts and turns them. `glyphs`: indices of voxels.
std::vector<float> gather(const std::vector<float>& data, std::size_t voxel_count, const std::vector<std::size_t>& glyphs,
                          ShLayout layout, ShConvention convention, const std::optional<ShRotation>& rotation) {
    const std::size_t count = layout.count();
    std::vector<float> coefficients(glyphs.size() * count);
    parallelFor(glyphs.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = 0; c < count; ++c) {
            const float* volume = data.data() + c * voxel_count;
            for (std::size_t g = begin; g < end; ++g) coefficients[g * count + c] = volume[glyphs[g]];
        }
        std::vector<double> exact(count);
        for (std::size_t g = begin; g < end; ++g) {
            const auto one = std::span(coefficients).subspan(g * count, count);
            std::ranges::copy(one, exact.begin());
            convertSh(std::span<double>(exact), layout, convention, ShConvention::kDescoteaux07);
            if (rotation) rotation->apply(exact);
            std::ranges::transform(exact, one.begin(), [](double value) { return static_cast<float>(value); });
        }
    });
    return coefficients;
}

}  // namespace

namespace {

/// The image without its voxels, from a checked header.
model::ShImage fromHeader(const StoredImage& stored, const ShOptions& options, const std::string& file) {
    model::ShImage image;
    image.layout = layoutOf(stored, options, file);
    setGrid(stored, file, image);
    image.file_convention = options.convention.value_or(ShConvention::kTournier07);
    image.file_axes = options.axes.value_or(ShAxes::kWorld);
    return image;
}

}  // namespace

model::ShImage readShHeader(const std::filesystem::path& path, const ShOptions& options) {
    return fromHeader(readStoredImage(path), options, path.filename().string());
}

model::ShImage readShImage(const std::filesystem::path& path, const ShOptions& options) {
    const StoredImage stored = readStoredImage(path);
    model::ShImage image = fromHeader(stored, options, path.filename().string());
    const std::vector<float> data = readSamples(stored);
    const std::size_t voxel_count = data.size() / image.layout.count();
    const std::vector<std::size_t> glyphs = setVoxels(data, voxel_count, image);
    std::optional<ShRotation> rotation;
    if (image.file_axes == ShAxes::kVoxel) {
        rotation.emplace(image.layout, orthogonalPolarFactor(glm::dmat3(image.voxel_to_world)));
    }
    image.coefficients = gather(data, voxel_count, glyphs, image.layout, image.file_convention, rotation);
    return image;
}

std::string describe(const model::ShImage& image) {
    const std::string read_as =
        image.tensor_order > 0
            ? "tensors of order " + std::to_string(image.tensor_order) + ", read as " + image.tensor_format
            : std::string(image.layout.full ? "full" : "even") + " bands to " + std::to_string(image.layout.lmax) + " (" +
                  std::to_string(image.layout.count()) + " volumes), read as " + std::string(name(image.file_convention));
    return image.source + ": " + std::to_string(image.voxels.size()) + " glyphs in " + std::to_string(image.size.x) + " x " +
           std::to_string(image.size.y) + " x " + std::to_string(image.size.z) + " voxels, " + read_as +
           " with directions in " + std::string(name(image.file_axes)) + " axes; " + std::to_string(image.rejected_voxels) +
           " voxels left out for NaN or infinity";
}

}  // namespace radiata::io
