// The 1000 bytes in front of a TrackVis file, and the way from its coordinates to the scanner's.
#pragma once

#include <cstdint>
#include <string>

#include "io/byte_source.h"
#include "model/tractogram.h"

namespace radiata::io {

struct TrkHeader {
    bool swapped = false;                ///< bytes stand in the other order than this machine's
    glm::dmat4 to_world{1.0};            ///< of the stored points
    std::size_t scalars = 0;             ///< numbers per vertex after its coordinates
    std::size_t properties = 0;          ///< numbers per track after its vertices
    model::TractogramHeader tractogram;  ///< columns, grid, count, remarks
};

/// \throws Error(kCorrupt, kUnsupported) naming field and value
TrkHeader readTrkHeader(ByteSource& source);

}  // namespace radiata::io
