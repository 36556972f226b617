#include "build/fiblet_paper.h"

#include <cmath>
#include <cstring>
#include <string>

#include "base/error.h"
#include "build/fiblet_code.h"

namespace radiata {
namespace {

constexpr std::size_t kCodes = 12, kFibre = 70, kIndex = 74, kFlags = 75;

/// Eq. 2: columns forward, left and up; the constant vector is y, so that a straight step is the identity, or z where forward
/// is along y.
glm::dmat3 frameOf(glm::dvec3 forward) {
    const glm::dvec3 v = std::abs(forward.y) > 0.999999 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 up = glm::normalize(glm::cross(forward, v));
    return {forward, glm::cross(up, forward), up};
}

glm::dvec3 directionOf(std::uint8_t code, double ratio) { return glm::dvec3(axisOf(codeTurn(code, 8, float(ratio)))); }

glm::dvec3 placeOf(const PaperFiblet& fiblet, std::size_t byte, const PaperCodec& codec) {
    std::uint16_t cells[3];
    std::memcpy(cells, fiblet.data() + byte, sizeof cells);
    return codec.origin_mm + glm::dvec3(cells[0], cells[1], cells[2]) * (codec.extent_mm / 65535);
}

void putPlace(glm::vec3 point, std::size_t byte, const PaperCodec& codec, PaperFiblet& fiblet) {
    const glm::dvec3 place = glm::clamp((glm::dvec3(point) - codec.origin_mm) / codec.extent_mm, 0.0, 1.0) * 65535.0;
    const std::uint16_t cells[3] = {std::uint16_t(std::lround(place.x)), std::uint16_t(std::lround(place.y)),
                                    std::uint16_t(std::lround(place.z))};
    std::memcpy(fiblet.data() + byte, cells, sizeof cells);
}

/// Direction of the first segment from the two rounded points; its length is the step, theirs is useless.
glm::dvec3 firstDirection(const PaperFiblet& fiblet, const PaperCodec& codec) {
    const glm::dvec3 d = placeOf(fiblet, 6, codec) - placeOf(fiblet, 0, codec);
    return glm::length(d) > 0 ? glm::normalize(d) : glm::dvec3(1, 0, 0);
}

}  // namespace

PaperFiblet encodePaper(std::span<const glm::vec3> points, std::uint32_t fibre, std::uint32_t index, bool begins, bool ends,
                        const PaperCodec& codec, PaperAim aim) {
    if (points.empty() || points.size() > kPaperPoints || index > 255) {
        throw Error(Code::kInvalidArgument, "fiblet " + std::to_string(index) + " of fibre " + std::to_string(fibre) + " has " +
                                                std::to_string(points.size()) +
                                                " points; the paper's layout holds 1 to 60, and 256 fiblets per fibre");
    }
    PaperFiblet fiblet{};
    putPlace(points[0], 0, codec, fiblet);
    putPlace(points[points.size() > 1 ? 1 : 0], 6, codec, fiblet);
    std::memcpy(fiblet.data() + kFibre, &fibre, 4);
    fiblet[kIndex] = std::uint8_t(index);
    fiblet[kFlags] = std::uint8_t((begins ? 1 : 0) | (ends ? 2 : 0) | points.size() << 2);
    glm::dmat3 frame = frameOf(firstDirection(fiblet, codec));
    glm::dvec3 decoded = placeOf(fiblet, 0, codec) + codec.step_mm * frame[0];
    for (std::size_t i = 2; i < points.size(); ++i) {
        const glm::dvec3 wanted = glm::dvec3(points[i]) - (aim == PaperAim::kPosition ? decoded : glm::dvec3(points[i - 1]));
        const glm::dvec3 local = wanted * frame;
        const std::uint8_t code =
            glm::length(local) > 0 ? std::uint8_t(nearestCode(glm::vec3(local), 8, float(codec.ratio))) : 0;
        fiblet[kCodes + i - 2] = code;
        frame = frame * frameOf(directionOf(code, codec.ratio));
        decoded += codec.step_mm * frame[0];
    }
    return fiblet;
}

std::vector<glm::dvec3> decodePaper(const PaperFiblet& fiblet, const PaperCodec& codec) {
    const std::size_t count = fiblet[kFlags] >> 2;
    std::vector<glm::dvec3> points{placeOf(fiblet, 0, codec)};
    glm::dmat3 frame = frameOf(firstDirection(fiblet, codec));
    for (std::size_t i = 1; i < count; ++i) {
        if (i > 1) frame = frame * frameOf(directionOf(fiblet[kCodes + i - 2], codec.ratio));
        points.push_back(points.back() + codec.step_mm * frame[0]);
    }
    return points;
}

}  // namespace radiata
