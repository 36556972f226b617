// Fiblets as the paper lays them out, for comparison: 76 bytes for up to 60 points (Schertzer et al. 2022, Sec. 3.2.2, Fig. 3,
// App. A and B, as corrected: the place on the cap is clamped to it, the quotient of roots simplified, frames continued from
// P(i + 1) - P(i)).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace radiata {

inline constexpr std::size_t kPaperPoints = 60, kPaperBytes = 76;

/// Points 0 and 1 as three times 16 bits each, 58 codes of 8 bits, fibre (4 bytes), number within the fibre (1 byte), flags
/// (begin: bit 0, end: bit 1) with the number of points above them.
using PaperFiblet = std::array<std::uint8_t, kPaperBytes>;

/// What all fiblets share.
struct PaperCodec {
    glm::dvec3 origin_mm{0};
    double extent_mm = 1;  ///< side of the cube that is scaled to [0, 1]^3
    double step_mm = 0.1;
    double ratio = 0.01;  ///< 1 - cos(largest turn)
};

/// How the encoder aims.
enum class PaperAim {
    kDirection,  ///< along the given segment, in the decoded frame: what the paper's errors are those of
    kPosition,   ///< from the decoded point to the given next one: the same bytes, errors do not add up
};

/// \param points  1 to 60, a constant step apart
/// \throws Error(kInvalidArgument) for other numbers of points, or a number within the fibre above 255
PaperFiblet encodePaper(std::span<const glm::vec3> points, std::uint32_t fibre, std::uint32_t index, bool begins, bool ends,
                        const PaperCodec& codec, PaperAim aim);

/// World mm.
std::vector<glm::dvec3> decodePaper(const PaperFiblet& fiblet, const PaperCodec& codec);

}  // namespace radiata
