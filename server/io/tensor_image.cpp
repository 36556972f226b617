#include "io/tensor_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "io/glyph_voxels.h"
#include "io/stored_image.h"
#include "math/cartesian_tensor.h"
#include "math/elasticity.h"
#include "math/polar.h"
#include "math/tensor_sh.h"

namespace radiata::io {
namespace {

/// Where each symmetric component of order 2 (xx, xy, xz, yy, yz, zz) stands among the volumes.
using Order2 = std::array<std::size_t, 6>;
constexpr Order2 kMrtrixOrder{0, 3, 4, 1, 5, 2};
constexpr Order2 kDipyOrder{0, 1, 3, 2, 4, 5};
constexpr Order2 kFslOrder{0, 1, 2, 3, 4, 5};

/// Share of the sum of |traces| by which the header's may be off: it was written by people, with few digits.
constexpr double kTraceTolerance = 1e-4;

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.7g", value);
    return text;
}

std::string countsText(bool entries) {
    std::string text;
    for (int order = kTensorOrderMin; order <= kTensorOrderMax; ++order) {
        text += (order == kTensorOrderMin   ? ""
                 : order == kTensorOrderMax ? " or "
                                            : ", ") +
                std::to_string(entries ? entryCount(order) : symmetricCount(order));
    }
    return text;
}

/// The order of tensors of any order from their number of volumes.
int orderOfVolumes(std::uint64_t volumes, bool entries, const std::string& file) {
    for (int order = kTensorOrderMin; order <= kTensorOrderMax; ++order) {
        if (volumes == (entries ? entryCount(order) : symmetricCount(order))) return order;
    }
    throw Error(Code::kCorrupt, file + ": the image has " + std::to_string(volumes) + " volumes; " +
                                    (entries ? "all entries" : "the symmetric components") +
                                    " of tensors of order 2 to 12 are " + countsText(entries));
}

void requireVolumes(std::uint64_t volumes, bool fits, TensorFormat format, const std::string& right, const std::string& file) {
    if (fits) return;
    throw Error(Code::kCorrupt, file + ": the image has " + std::to_string(volumes) + " volumes; " + std::string(name(format)) +
                                    " tensors have " + right);
}

TensorFormat chooseFormat(const StoredImage& stored, const TensorOptions& options, const std::string& file) {
    if (!options.format && !stored.tensor) {
        throw Error(Code::kInvalidArgument,
                    file +
                        ": nothing says which volume is which component; name a tensor format, or write tensor_order into a "
                        ".mif or .mih header");
    }
    if (options.format && stored.tensor && *options.format != stored.tensor->components) {
        throw Error(Code::kInvalidArgument,
                    file + ": the header says that the volumes are '" + std::string(name(stored.tensor->components)) +
                        "', the request reads them as '" + std::string(name(*options.format)) + "'; leave the format out");
    }
    return stored.tensor ? stored.tensor->components : *options.format;
}

int orderOf(const StoredImage& stored, TensorFormat format, const std::string& file) {
    const auto volumes = static_cast<std::uint64_t>(stored.size[3]);
    switch (format) {
        case TensorFormat::kMrtrix:
        case TensorFormat::kDipy:
        case TensorFormat::kFsl:
            requireVolumes(volumes, volumes == 6, format, "6", file);
            return 2;
        case TensorFormat::kVoigtStiffness:
        case TensorFormat::kVoigtCompliance:
        case TensorFormat::kMandel:
            requireVolumes(volumes, volumes == 21 || volumes == 36, format, "21 (upper triangle) or 36", file);
            return 4;
        case TensorFormat::kSymmetric:
        case TensorFormat::kEntries:
            break;
    }
    const bool entries = format == TensorFormat::kEntries;
    if (!stored.tensor) return orderOfVolumes(volumes, entries, file);
    const int order = stored.tensor->order;
    const std::size_t wanted = entries ? entryCount(order) : symmetricCount(order);
    if (volumes != wanted) {
        throw Error(Code::kCorrupt, file + ": the image has " + std::to_string(volumes) + " volumes; tensor_order " +
                                        std::to_string(order) + " with tensor_components " + std::string(name(format)) +
                                        " needs " + std::to_string(wanted));
    }
    return order;
}

/// The symmetric components of one voxel's samples.
std::vector<double> componentsOf(std::span<const double> samples, TensorFormat format, int order) {
    const auto placed = [&](const Order2& places) {
        std::vector<double> components;
        for (const std::size_t place : places) components.push_back(samples[place]);
        return components;
    };
    const auto matrix = [&](ElasticityConvention convention) {
        return samples.size() == 36 ? symmetricFromMatrix(samples, convention)
                                    : symmetricFromMatrix(fullMatrix(samples), convention);
    };
    switch (format) {
        case TensorFormat::kMrtrix:
            return placed(kMrtrixOrder);
        case TensorFormat::kDipy:
            return placed(kDipyOrder);
        case TensorFormat::kFsl:
            return placed(kFslOrder);
        case TensorFormat::kVoigtStiffness:
            return matrix(ElasticityConvention::kVoigtStiffness);
        case TensorFormat::kVoigtCompliance:
            return matrix(ElasticityConvention::kVoigtCompliance);
        case TensorFormat::kMandel:
            return matrix(ElasticityConvention::kMandel);
        case TensorFormat::kEntries:
            return symmetricPart(order, samples);
        case TensorFormat::kSymmetric:
            break;
    }
    return {samples.begin(), samples.end()};
}

/// What turns the file's directions to world axes.
std::optional<TensorRotation> rotationOf(const model::ShImage& image, TensorFormat format, const TensorOptions& options) {
    if (image.file_axes == ShAxes::kWorld) return {};
    const glm::dmat3 grid(image.voxel_to_world);
    glm::dmat3 turn = orthogonalPolarFactor(grid);
    if (format == TensorFormat::kFsl && !options.axes && glm::determinant(grid) > 0) turn[0] = -turn[0];
    return TensorRotation(image.tensor_order, turn);
}

void toFloats(std::span<const double> values, std::span<float> floats, const std::string& file) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        floats[i] = static_cast<float>(values[i]);
        if (std::isfinite(floats[i])) continue;
        throw Error(Code::kCorrupt, file + ": a tensor has a coefficient of " + number(values[i]) +
                                        "; it must be within the range of 32-bit floats");
    }
}

void checkTrace(const model::ShImage& image, double expected, const std::vector<double>& traces) {
    double sum = 0, size = 0;
    for (const double trace : traces) {
        sum += trace;
        size += std::abs(trace);
    }
    if (std::abs(sum - expected) <= kTraceTolerance * std::max(size, std::abs(expected))) return;
    throw Error(Code::kCorrupt, image.source + ": the tensors' traces add up to " + number(sum) +
                                    ", the header's tensor_trace is " + number(expected) +
                                    "; order or tensor_components are not those of the samples");
}

model::ShImage fromHeader(const StoredImage& stored, const TensorOptions& options, const std::string& file) {
    model::ShImage image;
    const TensorFormat format = chooseFormat(stored, options, file);
    image.tensor_order = orderOf(stored, format, file);
    image.tensor_format = std::string(name(format));
    image.layout = TensorSh(image.tensor_order).layout();
    setGrid(stored, file, image);
    const bool voxel_axes = format == TensorFormat::kDipy || format == TensorFormat::kFsl;
    image.file_axes = options.axes.value_or(voxel_axes ? ShAxes::kVoxel : ShAxes::kWorld);
    image.file_convention = ShConvention::kDescoteaux07;
    return image;
}

}  // namespace

model::ShImage readTensorHeader(const std::filesystem::path& path, const TensorOptions& options) {
    return fromHeader(readStoredImage(path), options, path.filename().string());
}

model::ShImage readTensorImage(const std::filesystem::path& path, const TensorOptions& options) {
    const StoredImage stored = readStoredImage(path);
    const std::string file = path.filename().string();
    model::ShImage image = fromHeader(stored, options, file);
    const TensorFormat format = chooseFormat(stored, options, file);
    const std::vector<float> data = readSamples(stored);
    const auto volumes = static_cast<std::size_t>(stored.size[3]);
    const std::size_t voxel_count = data.size() / volumes;
    const std::vector<std::size_t> glyphs = setVoxels(data, voxel_count, image);

    const int order = image.tensor_order;
    const TensorSh map(order);
    const std::optional<TensorRotation> rotation = rotationOf(image, format, options);
    const std::size_t stride = symmetricCount(order), count = image.layout.count();
    image.tensors.resize(glyphs.size() * stride);
    image.coefficients.resize(glyphs.size() * count);
    std::vector<double> traces(glyphs.size());
    parallelFor(glyphs.size(), 256, [&](std::size_t begin, std::size_t end) {
        std::vector<double> samples(volumes), coefficients(count);
        for (std::size_t g = begin; g < end; ++g) {
            for (std::size_t v = 0; v < volumes; ++v) samples[v] = static_cast<double>(data[v * voxel_count + glyphs[g]]);
            std::vector<double> components = componentsOf(samples, format, order);
            traces[g] = fullTrace(order, components);
            if (rotation) rotation->apply(components);
            map.toSh(components, coefficients);
            toFloats(components, std::span(image.tensors).subspan(g * stride, stride), file);
            toFloats(coefficients, std::span(image.coefficients).subspan(g * count, count), file);
        }
    });
    if (stored.tensor && stored.tensor->trace) checkTrace(image, *stored.tensor->trace, traces);
    return image;
}

bool namesTensors(const std::filesystem::path& path) { return readStoredImage(path).tensor.has_value(); }

}  // namespace radiata::io
