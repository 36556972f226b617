// DSI Studio's TinyTrack files, .tt.gz (and .tt), read batch by batch.
// Format: DSI Studio documentation, "TinyTrack"; a MATLAB version 4 file whose matrix "track" is a run of bytes: for each
// track the count of its coordinates (uint32), its first point (3 int32) and the steps to the others (3 int8 each), in
// 1/32 of a voxel.
#pragma once

#include <filesystem>
#include <memory>

#include "model/tractogram.h"

namespace radiata::io {

/// Points are placed by the matrix trans_to_mni, or, with a remark, by the voxel size alone if there is none. A matrix
/// "cluster" of as many numbers as tracks becomes the fibre column "cluster". \throws Error(kCorrupt) naming matrix, track,
/// offset and value
std::unique_ptr<model::TractogramSource> openTt(const std::filesystem::path& path);

}  // namespace radiata::io
