// The arithmetic of fiblet codes in float32, for the encoder and for whoever decodes on the CPU. The shaders' is
// shaders/common/fiblet_decode.glsl; both follow docs/formats/fiblet.md.
#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include "model/fiblet_set.h"

namespace radiata {

/// A rotation as a quaternion.
struct Turn {
    float w = 1, x = 0, y = 0, z = 0;
};

inline Turn operator*(const Turn& a, const Turn& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z, a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x};
}

/// Where the rotation takes the x axis.
inline glm::vec3 axisOf(const Turn& q) {
    return {1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z), 2 * (q.x * q.z - q.w * q.y)};
}

/// v in the frame that the rotation makes of the axes.
glm::vec3 intoFrame(const Turn& q, glm::vec3 v);

/// The turn of a code; width 4, 6, 8 or 16; ratio = 1 - cos(cap).
Turn codeTurn(std::uint32_t code, std::uint32_t width, float ratio);

/// The code whose turn points nearest to a direction (up to the grid's rounding), which may lie outside of the cap.
/// \param v  in the frame of the last segment, any length but 0
std::uint32_t nearestCode(glm::vec3 v, std::uint32_t width, float ratio);

/// First direction as two numbers, and the frame that they stand for. \param direction  any length; 0 gives the x axis
glm::ivec2 packDirection(glm::dvec3 direction);
Turn firstFrame(glm::ivec2 packed);

/// Appends bits, lowest first.
void putBits(std::span<std::uint32_t> words, std::uint32_t bit, std::uint32_t width, std::uint32_t value);
std::uint32_t getBits(const std::uint32_t* words, std::uint32_t bit, std::uint32_t width);

/// Points of a fiblet relative to its point 0, mm; fibletSegments(head) + 1 of them.
/// \param words   the fiblet's first word of codes
/// \param points  room for 64
std::uint32_t decodeOffsets(const model::FibletHead& head, const std::uint32_t* words, const shader::FibletCodec& codec,
                            glm::vec3* points);

/// Point 0, mm from the set's origin.
glm::dvec3 fibletStart(const model::FibletHead& head, const shader::FibletCodec& codec);

/// All points of a fibre of a set in world mm. \throws Error(kInvalidArgument) for a fibre the set does not have
std::vector<glm::dvec3> decodeFibre(const model::FibletSet& set, std::uint64_t fibre);

}  // namespace radiata
