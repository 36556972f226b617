// The fixed parts of a .fiblet file; docs/formats/fiblet.md describes it in words. All numbers are little-endian.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include <zlib.h>

#include "model/fiblet_set.h"

namespace radiata::io::fiblet {

static_assert(std::endian::native == std::endian::little, "files are written as they stand in memory");

/// The first byte is no text, and the line ends show a transfer that changed them.
inline constexpr std::array<unsigned char, 8> kMagic{0x89, 'F', 'I', 'B', 'L', 'T', '\r', '\n'};
inline constexpr std::uint32_t kVersion = 1;
inline constexpr std::uint32_t kSectionsMax = 65536, kNameMax = 1024, kComponentsMax = 4096, kRemarksMax = 65536;
inline constexpr std::uint64_t kAlignment = 64;

struct Header {
    std::array<unsigned char, 8> magic;
    std::uint32_t version, sections;
    std::uint64_t file_bytes, fibres, fiblets, points;
    std::array<double, 3> origin_mm;
    shader::FibletCodec codec;
    double bound_um, mean_um, max_um;
    std::uint64_t measured_points, walked;
    double walk_mean_um, walk_max_um;
    std::uint64_t walk_points;
    std::uint32_t crc;  ///< of this struct with 0 here, then of all Section structs
    std::uint32_t reserved;
};
static_assert(sizeof(Header) == 216);

enum Kind : std::uint32_t {
    kHeads = 1,         ///< FibletHead[fiblets]
    kCodes = 2,         ///< uint32[]
    kPages = 3,         ///< FibletPage[]
    kPageChecks = 4,    ///< uint32[pages]: CRC of a page's heads, then its codes
    kFibreFirst = 5,    ///< uint32[fibres + 1]
    kFibreFiblets = 6,  ///< uint32[fiblets]
    kFibreColumn = 16,  ///< Name with components, float[fibres * components]
    kPointColumn = 17,  ///< Name with component's number, float[fiblets][2], uint8[fiblets][64]
    kGroup =
        18,  ///< Name with number of columns, uint64 fibres, uint32[fibres], columns: Name with components, float[components]
    kRemarks = 19,  ///< UTF-8, at most kRemarksMax bytes
};

struct Section {
    std::uint32_t kind;
    std::uint32_t crc;  ///< of its bytes; 0 for heads and codes, which have one per page
    std::uint64_t offset, bytes;
};
static_assert(sizeof(Section) == 24);

/// Before a name, whose bytes follow, filled up with zeros to a multiple of 8.
struct Name {
    std::uint32_t bytes, number;
};

inline std::uint32_t crcOf(std::span<const std::byte> bytes, std::uint32_t before = 0) {
    // Nothing may be at no address, for which zlib begins anew.
    if (bytes.empty()) return before;
    return std::uint32_t(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

inline std::uint64_t aligned(std::uint64_t bytes, std::uint64_t to) { return (bytes + to - 1) / to * to; }

/// Words of codes of page p, the whole section having `words` of them.
inline std::uint64_t pageWords(std::span<const shader::FibletPage> pages, std::size_t p, std::uint64_t words) {
    return (p + 1 < pages.size() ? pages[p + 1].first_word : words) - pages[p].first_word;
}

}  // namespace radiata::io::fiblet
