#include "io/stored_image.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <new>

#include "base/checked.h"
#include "base/error.h"
#include "io/byte_source.h"
#include "io/mrtrix_header.h"
#include "io/nifti_header.h"
#include "io/nrrd_header.h"

namespace radiata::io {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 20;  // holds whole numbers of every type

std::uint64_t sampleCount(const StoredImage& image) {
    std::uint64_t count = 1;
    for (const std::int64_t length : image.size) {
        count = checkedMultiply(count, static_cast<std::uint64_t>(length), image.data_path.filename().string());
    }
    return count;
}

/// Samples in the order of the file.
std::vector<float> readInFileOrder(const StoredImage& image) {
    const std::uint64_t count = sampleCount(image);
    const std::uint64_t bits = bitsOf(image.type);
    const std::uint64_t bytes = (checkedMultiply(count, bits, "image size") + 7) / 8;
    ByteSource source(image.data_path, image.packing, image.packed_offset);
    source.requireContent(checkedAdd(image.data_offset, bytes, source.name()));
    source.skipTo(image.data_offset);

    std::vector<float> samples;
    if (!source.compressed()) samples.reserve(count);
    std::vector<std::byte> block(std::min<std::uint64_t>(kBlockBytes, bytes));
    for (std::uint64_t done = 0; done < bytes;) {
        const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(block.size(), bytes - done));
        const std::size_t got = source.read(std::span(block).first(wanted));
        if (got < wanted) {
            throw Error(Code::kCorrupt, source.name() + ": the file ends after " + std::to_string(done + got) + " of " +
                                            std::to_string(bytes) + " bytes of samples");
        }
        const std::size_t before = samples.size();
        const auto numbers = static_cast<std::size_t>(std::min<std::uint64_t>(wanted * 8 / bits, count - before));
        samples.resize(before + numbers);
        decodeSamples(image.type, image.swapped, image.slope, image.intercept, std::span(block).first(wanted),
                      std::span(samples).subspan(before));
        done += wanted;
    }
    source.finish();
    return samples;
}

/// From the order of the file to x, y, z, volume.
std::vector<float> reorder(const StoredImage& image, const std::vector<float>& stored) {
    // Walk through the file with one counter per rank; `step` is what that rank's axis means in the result.
    std::array<std::int64_t, 4> length{};
    std::array<std::int64_t, 4> step{};
    std::int64_t stride = 1;
    std::int64_t start = 0;
    for (std::size_t axis = 0; axis < 4; ++axis) {
        const auto rank = static_cast<std::size_t>(image.rank[axis]);
        length[rank] = image.size[axis];
        step[rank] = image.reversed[axis] ? -stride : stride;
        if (image.reversed[axis]) start += stride * (image.size[axis] - 1);
        stride *= image.size[axis];
    }
    std::vector<float> ordered(stored.size());
    const float* next = stored.data();
    for (std::int64_t d = 0; d < length[3]; ++d) {
        for (std::int64_t c = 0; c < length[2]; ++c) {
            for (std::int64_t b = 0; b < length[1]; ++b) {
                std::int64_t at = start + d * step[3] + c * step[2] + b * step[1];
                for (std::int64_t a = 0; a < length[0]; ++a, at += step[0]) ordered[static_cast<std::size_t>(at)] = *next++;
            }
        }
    }
    return ordered;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

}  // namespace

std::array<int, 4> fourAxes(std::span<const std::int64_t> lengths, const std::string& file) {
    std::array<int, 4> axes{-1, -1, -1, -1};
    std::uint64_t count = 1;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        if (lengths[i] < 1) {
            throw Error(Code::kCorrupt, file + ": axis " + std::to_string(i + 1) + " has length " + std::to_string(lengths[i]) +
                                            "; it must be at least 1");
        }
        count = checkedMultiply(count, static_cast<std::uint64_t>(lengths[i]), file + ": number of samples");
        if (i < 4) {
            axes[i] = static_cast<int>(i);
        } else if (lengths[i] > 1) {
            if (lengths[static_cast<std::size_t>(axes[3])] > 1) {
                throw Error(Code::kUnsupported, file + ": axes " + std::to_string(axes[3] + 1) + " and " +
                                                    std::to_string(i + 1) +
                                                    " are both longer than 1; only one axis "
                                                    "of volumes is read");
            }
            axes[3] = static_cast<int>(i);
        }
    }
    if (count > kSamplesMax) {
        throw Error(Code::kResourceExhausted, file + ": the header asks for " + std::to_string(count) + " samples; at most " +
                                                  std::to_string(kSamplesMax) + " (16 GiB as float) are read");
    }
    return axes;
}

void checkAffine(const glm::dmat4& voxel_to_world, const std::string& file) {
    auto refuse = [&](const std::string& what) {
        throw Error(Code::kCorrupt, file + ": the voxel-to-world matrix is unusable: " + what);
    };
    glm::dmat3 axes;
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 3; ++r) {
            const double value = voxel_to_world[c][r];
            if (!std::isfinite(value)) refuse("row " + std::to_string(r + 1) + " has " + number(value) + "; it must be finite");
            if (c == 3 && std::abs(value) > 1e9) refuse("the origin is at " + number(value) + "; it must be within 1e9 mm");
        }
    }
    for (int c = 0; c < 3; ++c) {
        const double edge_mm = glm::length(glm::dvec3(voxel_to_world[c]));
        if (!(edge_mm >= 1e-6 && edge_mm <= 1e6)) {
            refuse("voxel axis " + std::to_string(c + 1) + " is " + number(edge_mm) + " mm long; it must be 1e-6 to 1e6 mm");
        }
        axes[c] = glm::dvec3(voxel_to_world[c]) / edge_mm;
    }
    const double volume = std::abs(glm::determinant(axes));
    if (!(volume > 1e-6)) {
        refuse("it is singular (its unit axes span a volume of " + number(volume) + "; it must be above 1e-6)");
    }
}

StoredImage readStoredImage(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    if (name.ends_with(".nii") || name.ends_with(".nii.gz")) return readNiftiHeader(path);
    if (name.ends_with(".mif") || name.ends_with(".mif.gz") || name.ends_with(".mih")) return readMrtrixHeader(path);
    if (name.ends_with(".nrrd") || name.ends_with(".nhdr")) return readNrrdHeader(path);
    throw Error(Code::kUnsupported, name + ": the name must end in .nii, .nii.gz, .mif, .mif.gz, .mih, .nrrd or .nhdr");
}

std::vector<float> readSamples(const StoredImage& image) {
    const bool in_order = image.rank == std::array<int, 4>{0, 1, 2, 3} && std::ranges::none_of(image.reversed, std::identity{});
    try {
        std::vector<float> stored = readInFileOrder(image);
        return in_order ? stored : reorder(image, stored);
    } catch (const std::bad_alloc&) {
        throw Error(Code::kResourceExhausted, image.data_path.filename().string() + ": there is no memory for " +
                                                  std::to_string(sampleCount(image)) + " samples");
    }
}

}  // namespace radiata::io
