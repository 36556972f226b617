// TrackVis track files, .trk and .trk.gz, read batch by batch.
// Format: trackvis.org, "TrackVis track file format", versions 1 and 2; points are voxel indices times the voxel's size,
// counted from the corner of the first voxel, along the axes that the voxel order names.
#pragma once

#include <filesystem>
#include <memory>

#include "model/tractogram.h"

namespace radiata::io {

/// Scalars become vertex columns, properties fibre columns; a name followed by a zero byte and a number stands for that many
/// components, as nibabel writes them. The count of tracks in the header is a hint, the end of the file decides.
/// An order of axes that differs from the matrix' own is turned into it; a missing matrix is the identity, as nibabel has it.
/// \throws Error(kCorrupt) naming track, offset and value; Error(kUnsupported) for another version
std::unique_ptr<model::TractogramSource> openTrk(const std::filesystem::path& path);

}  // namespace radiata::io
