// The paper's layout of 76 bytes for up to 60 points (build/fiblet_paper.h) as a file, for comparison and exchange:
// docs/formats/fiblet76.md. Source: Schertzer et al. 2022, Sec. 3.2.2 and Fig. 3; the file around the records is ours.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "build/fiblet_encode.h"
#include "model/tractogram.h"

namespace radiata::ingest {

inline constexpr std::size_t kFiblet76Block = 1024;  ///< records that share a checksum

/// All numbers are little-endian.
struct Fiblet76Header {
    std::array<unsigned char, 8> magic;
    std::uint32_t version, record_bytes;
    std::uint64_t file_bytes, fibres, fiblets, points;
    std::array<double, 3> origin_mm;
    double extent_mm, step_mm, ratio;
    std::uint32_t crc;  ///< of this struct with 0 here
    std::uint32_t reserved;
};
static_assert(sizeof(Fiblet76Header) == 104);
inline constexpr std::array<unsigned char, 8> kFiblet76Magic{0x89, 'F', 'B', 'L', '7', '6', '\r', '\n'};

/// Fibres without points take no bytes; so that a short file cannot stand for billions of them, there are so many at most.
constexpr std::uint64_t fiblet76FibresMax(std::uint64_t fiblets) { return 4096 * (fiblets + 256); }

/// Whether a name ends in .fiblet76.
bool isFiblet76Name(const std::filesystem::path& path);

/// The fibres, decoded. \throws Error(kNotFound, kUnavailable) if it cannot be opened, (kUnsupported) for another version,
/// (kCorrupt) naming place, value and what would be right for a file that is cut off, changed or contradicts itself
std::unique_ptr<model::TractogramSource> openFiblet76(const std::filesystem::path& path);

struct Fiblet76Written {
    std::uint64_t fibres = 0, fiblets = 0, points = 0;
    double step_mm = 0;
    model::FibletErrors errors;       ///< of decoded points against those that were encoded
    bool walked = false;              ///< the steps varied, so points were set anew along the lines
    model::FibletErrors walk_errors;  ///< if so, of the original points against the new lines
    /// Lines end where a whole number of steps does, as there are no shorter last segments: of the ends, largest, um.
    double end_um = 0;
    std::string remarks;  ///< of the source
};

/// Codes aim from the point decoded so far at the next given one. Columns and groups are left out.
/// \param options  of step, bounds of the walk and what is left out; the others do not matter here
/// \throws Error(kInvalidArgument) naming a fibre that needs more than 256 fiblets, or as planFiblets(); (kUnavailable)
Fiblet76Written writeFiblet76(const OpenTractogram& open, const FibletOptions& options, const std::filesystem::path& path);

}  // namespace radiata::ingest
