// TRX tractograms, a zip file or a folder of arrays, read batch by batch and written.
// Format: the specification of the tee-ar-ex project: header.json, positions.3.*, offsets.*, dpv/ (per vertex), dps/ (per
// streamline), groups/ (lists of streamlines), dpg/ (per group).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "io/sample_type.h"
#include "io/trx_files.h"
#include "model/tractogram.h"

namespace radiata::io {

/// Offsets may hold the end of the last streamline or not. All arrays are little-endian, as the specification has it.
/// \throws Error(kCorrupt) naming array and value if the arrays contradict the header, offsets descend or a group names a
///         streamline that is not there; (kUnsupported) for an unknown number type; (kResourceExhausted) for more fibres than
///         can be numbered, or for positions that expand over a hundredfold, which no coordinates do
std::unique_ptr<model::TractogramSource> openTrx(const std::filesystem::path& path);

/// An array's place in the file and what its name says.
struct TrxArray {
    std::string entry;  ///< path within the file
    std::string name;   ///< "fa" of "dpv/fa.3.float32"
    std::uint64_t components = 1;
    SampleType type = SampleType::kFloat32;
};

/// What a file holds, checked against its header.
struct TrxHeader {
    model::TractogramHeader tractogram;
    std::uint64_t fibres = 0, points = 0;
    TrxArray positions, offsets;
    std::vector<TrxArray> vertex, fibre;  ///< in the order of the header's columns
    std::vector<TrxArray> groups;
};
TrxHeader readTrxHeader(const TrxFiles& files);
/// \throws Error(kCorrupt) naming group and index
std::vector<model::FibreGroup> readTrxGroups(const TrxFiles& files, const TrxHeader& header);

/// Writes a zip file (stored, so that readers can map it), or a folder if the path ends in '/'. Columns are float32, positions
/// float32, offsets uint64, groups uint32. Without a grid the identity and one voxel are written, as trx-python does. Arrays
/// are gathered in a folder PATH.part beside the file, so twice the room is needed for a moment; nothing stays if it fails.
/// Equal fibres give equal bytes.
/// \throws Error(kInvalidArgument) for a name that is taken by a file when a folder is wanted; (kUnavailable) if writing fails
void writeTrx(model::TractogramSource& source, const std::filesystem::path& path);

}  // namespace radiata::io
