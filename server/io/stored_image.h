// What the header of an image file says, the same for every format, checked but with no sample read yet.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "io/byte_source.h"
#include "io/sample_type.h"
#include "io/tensor_options.h"

namespace radiata::io {

/// The largest image that is read: 16 GiB as float.
constexpr std::uint64_t kSamplesMax = std::uint64_t{1} << 32;

struct StoredImage {
    std::array<std::int64_t, 4> size{1, 1, 1, 1};  ///< x, y, z, volumes; each at least 1
    glm::dmat4 voxel_to_world{1.0};                ///< checked: finite and invertible
    SampleType type = SampleType::kFloat32;
    bool swapped = false;  ///< bytes in the other order than this machine's
    double slope = 1;
    double intercept = 0;
    std::array<int, 4> rank{0, 1, 2, 3};  ///< rank[axis]: 0 for the axis that runs fastest in the file; a permutation
    std::array<bool, 4> reversed{false, false, false, false};  ///< the axis' last sample stands first
    std::filesystem::path data_path;
    Packing packing = Packing::kByName;
    std::uint64_t packed_offset = 0;     ///< bytes of the file itself before the content
    std::uint64_t data_offset = 0;       ///< bytes of (decompressed) content before the first sample
    std::optional<TensorHeader> tensor;  ///< the header calls the volumes components of a tensor
};

/// Puts n >= 1 axes into x, y, z and volumes: axes behind the third are the volumes, and at most one of them may be longer
/// than 1 (NIfTI keeps vectors on its fifth axis).
/// \return for each of the four axes which of the file's it is, or -1 for one that the file does not have (length 1)
/// \throws Error(kCorrupt) for a length below 1, (kUnsupported) for more axes, (kResourceExhausted) over kSamplesMax
std::array<int, 4> fourAxes(std::span<const std::int64_t> lengths, const std::string& file);

/// \throws Error(kCorrupt) unless all entries are finite, voxel edges are 1e-6 to 1e6 mm, the three axes span a volume, and the
///         origin lies within 1e9 mm
void checkAffine(const glm::dmat4& voxel_to_world, const std::string& file);

/// Reads the header of a .nii, .nii.gz, .mif, .mif.gz, .mih, .nrrd or .nhdr file.
/// \throws Error(kUnsupported) for another ending, else as readVolume()
StoredImage readStoredImage(const std::filesystem::path& path);

/// All samples as float, x fastest, then y, z, volume, whatever their order in the file.
/// Memory grows with what is really in the file, not with what its header claims.
/// \throws Error(kCorrupt) if the file ends early or is damaged
std::vector<float> readSamples(const StoredImage& image);

}  // namespace radiata::io
