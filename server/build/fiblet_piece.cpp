#include "build/fiblet_piece.h"

#include <algorithm>
#include <cmath>

#include "build/fiblet_code.h"

namespace radiata {

FibletPiece encodeGreedy(const FibletTargets& targets, std::uint32_t width_choice, std::uint32_t cap,
                         const shader::FibletCodec& codec) {
    FibletPiece piece;
    piece.width_choice = width_choice;
    piece.cap = cap;
    const std::uint32_t width = model::kFibletWidths[width_choice];
    const float ratio = codec.cap_ratio[cap];
    const auto note = [&](glm::vec3 point, std::uint32_t i) {
        const float error = glm::length(point - targets.points[i]);
        piece.max_error_mm = std::max(piece.max_error_mm, error);
        piece.sum_error_mm += error;
    };
    glm::vec3 point(0);
    note(point, 0);
    if (targets.segments == 0) return piece;
    piece.direction = packDirection(targets.points[1]);
    Turn frame = firstFrame(piece.direction);
    for (std::uint32_t i = 1; i <= targets.segments; ++i) {
        if (i > 1) {
            const glm::vec3 aim = intoFrame(frame, targets.points[i] - point);
            const std::uint32_t code = nearestCode(glm::dot(aim, aim) > 0 ? aim : glm::vec3(1, 0, 0), width, ratio);
            piece.codes[i - 2] = std::uint16_t(code);
            frame = frame * codeTurn(code, width, ratio);
        }
        point += (i == targets.segments ? targets.last_length_mm : codec.step_mm) * axisOf(frame);
        note(point, i);
    }
    return piece;
}

}  // namespace radiata
