// The text header that MRtrix3's track files (.tck) and track scalar files (.tsf) begin with.
// Format: MRtrix3 documentation, "Tracks file format (.tck)" and "Track scalar file format (.tsf)".
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "io/byte_source.h"
#include "io/sample_type.h"

namespace radiata::io {

struct TckHeader {
    SampleType type = SampleType::kFloat32;
    bool swapped = false;          ///< bytes stand in the other order than this machine's
    std::uint64_t data_begin = 0;  ///< offset of the first number
    std::optional<std::uint64_t> count;
    std::string remarks;  ///< what was missing and assumed
};

/// Reads a header from the front of a file. A missing datatype stands for Float32LE and a missing "file" for data right after
/// END; programs other than MRtrix3 leave them out.
/// \param magic  the first line: "mrtrix tracks" or "mrtrix track scalars"
/// \throws Error(kCorrupt) naming the line; (kUnsupported) for data in another file or an unknown datatype
TckHeader readTckHeader(ByteSource& source, const std::string& magic);

}  // namespace radiata::io
