// Images on a voxel grid as float, from NIfTI, MRtrix and NRRD files.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace radiata::io {

struct Volume {
    std::array<std::int64_t, 4> size{1, 1, 1, 1};  ///< voxels along x, y, z; volumes
    glm::dmat4 voxel_to_world{1.0};                ///< voxel centres have whole indices; world mm, RAS
    std::vector<float> data;                       ///< x fastest, then y, z, volume; intensity scaling applied
    std::string source;                            ///< file name for messages
};

/// Reads .nii and .nii.gz (NIfTI-1 and -2), .mif, .mif.gz, .mih, .nrrd and .nhdr: every real data type, both byte orders, any
/// axis order. The voxel axes stay those of the file: nothing is flipped towards RAS, voxel_to_world says where each voxel is.
/// \throws Error naming file, field, value and what would be right: kNotFound (no such file), kUnsupported (complex, colour,
/// another
///         format), kCorrupt (truncated, lying, empty, singular or non-finite matrix), kInvalidArgument (a .mih or
///         .nhdr file that names data outside its folder), kResourceExhausted (over 16 GiB as float)
Volume readVolume(const std::filesystem::path& path);

}  // namespace radiata::io
