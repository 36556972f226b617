// Some fibres of a tractogram that stand for all of them: those that are always on the device where the whole is too large for
// it.
#pragma once

#include <cstdint>
#include <vector>

#include "model/fiblet_set.h"
#include "shaders/shared/fiblet_draw.glsl"

namespace radiata {

/// Whole fibres, taken at random by a fixed seed, so equal sets and sizes give equal subsets. Their fiblets stand page by page
/// in the order of the set; the codes' places in the heads are counted from the first word of what is left of each page.
struct FibletSubset {
    std::vector<model::FibletHead> heads;
    std::vector<shader::FibletBox> boxes;
    std::vector<std::uint32_t> codes;
    std::vector<shader::FibletPlace> places;  ///< one per page of the set
    std::uint64_t fibres = 0;
};

/// \param bytes_max  of heads, boxes and codes together
FibletSubset fibletSubset(const model::FibletSet& set, std::uint64_t bytes_max);

}  // namespace radiata
