// Encoding one fiblet: codes that keep the decoded points near the given ones. Each direction is aimed from the point that was
// decoded so far to the next given point, so errors do not add up (position feedback).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include "model/fiblet_set.h"

namespace radiata {

/// What one fiblet is to reproduce.
struct FibletTargets {
    std::uint32_t segments = 0;          ///< up to FIBLET_SEGMENTS
    std::array<glm::vec3, 64> points{};  ///< segments + 1, mm, relative to the place that point 0 will be decoded to
    float last_length_mm = 0;            ///< of the last segment
    std::array<float, 64> turn{};        ///< turn[i]: 1 - cos(angle) at point i, for i from 1 to segments - 1
};

/// One way to encode it.
struct FibletPiece {
    std::uint32_t width_choice = 0, cap = 0;
    glm::ivec2 direction{0};
    std::array<std::uint16_t, 62> codes{};
    float max_error_mm = 0;
    double sum_error_mm = 0;  ///< over points 0 to segments
};

/// With codes of one width and one cap, each the nearest to its aim.
FibletPiece encodeGreedy(const FibletTargets& targets, std::uint32_t width_choice, std::uint32_t cap,
                         const shader::FibletCodec& codec);

}  // namespace radiata
