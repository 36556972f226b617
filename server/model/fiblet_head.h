// Reading and making the bits of a fiblet's head on the CPU; layout in shaders/shared/fiblet.glsl.
#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include "shaders/shared/fiblet.glsl"

namespace radiata::model {

using shader::FibletHead;

/// Bits a code of each of the four widths takes.
inline constexpr std::array<std::uint32_t, 4> kFibletWidths{4, 6, 8, 16};
/// A fibre has at most this many fiblets, hence 63 * 4096 segments.
inline constexpr std::uint32_t kFibletsPerFibre = 4096;
inline constexpr std::uint32_t kFibletCellMax = (1U << 20) - 1;

/// A head in parts.
struct FibletParts {
    glm::uvec3 cell{0};       ///< of point 0, each up to kFibletCellMax
    std::uint32_t cap = 0;    ///< below FIBLET_CAPS
    glm::ivec2 direction{0};  ///< of the first segment, -32767 to 32767
    std::uint32_t fibre = 0;
    std::uint32_t segments = 0;      ///< up to FIBLET_SEGMENTS
    std::uint32_t width_choice = 0;  ///< index into kFibletWidths
    bool last = false, shortened = false;
    std::uint32_t word = 0;   ///< of the first code, from the page's first word; even, below 2048
    std::uint32_t index = 0;  ///< within the fibre, below kFibletsPerFibre
};

inline FibletHead packHead(const FibletParts& p) {
    FibletHead head{};
    head.place0 = p.cell.x | p.cell.y << 20;
    head.place1 = p.cell.y >> 12 | p.cell.z << 8 | p.cap << 28;
    head.direction = std::uint32_t(p.direction.x & 0xffff) | std::uint32_t(p.direction.y & 0xffff) << 16;
    head.fibre = p.fibre;
    head.shape = p.segments | p.width_choice << 6 | std::uint32_t(p.last) << 8 | std::uint32_t(p.shortened) << 9 |
                 (p.word / 2) << 10 | p.index << 20;
    return head;
}

inline std::uint32_t fibletSegments(const FibletHead& h) { return h.shape & 63U; }
inline std::uint32_t fibletWidth(const FibletHead& h) { return kFibletWidths[h.shape >> 6 & 3U]; }
inline bool fibletIsLast(const FibletHead& h) { return (h.shape >> 8 & 1U) != 0; }
inline bool fibletIsShortened(const FibletHead& h) { return (h.shape >> 9 & 1U) != 0; }
/// From the page's first word.
inline std::uint32_t fibletWord(const FibletHead& h) { return 2 * (h.shape >> 10 & 1023U); }
inline std::uint32_t fibletIndex(const FibletHead& h) { return h.shape >> 20; }
inline std::uint32_t fibletCap(const FibletHead& h) { return h.place1 >> 28; }
inline glm::uvec3 fibletCell(const FibletHead& h) {
    return {h.place0 & kFibletCellMax, h.place0 >> 20 | (h.place1 & 0xffU) << 12, h.place1 >> 8 & kFibletCellMax};
}

/// Words of codes, and of the shortened segment's length, that a fiblet of this shape takes; even.
inline std::uint32_t fibletWords(std::uint32_t segments, std::uint32_t width, bool shortened) {
    const std::uint32_t bits = (segments > 0 ? segments - 1 : 0) * width + (shortened ? 16 : 0);
    return 2 * ((bits + 63) / 64);
}

}  // namespace radiata::model
