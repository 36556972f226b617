#include "reference/fiblet.h"

#include <algorithm>
#include <cmath>

namespace radiata::reference {
namespace {

/// A row of bits, lowest of the first word first.
class Bits {
public:
    explicit Bits(std::span<const std::uint32_t> words) : words_(words) {}
    unsigned take(unsigned count) {
        unsigned value = 0;
        for (unsigned i = 0; i < count; ++i, ++at_) value += (words_[at_ / 32] >> (at_ % 32) & 1U) << i;
        return value;
    }

private:
    std::span<const std::uint32_t> words_;
    std::size_t at_ = 0;
};

struct Frame {
    glm::dvec3 forward, left, up;
    /// All three by an angle about a unit axis.
    void rotate(glm::dvec3 axis, double angle) {
        for (glm::dvec3* v : {&forward, &left, &up}) {
            *v = *v * std::cos(angle) + glm::cross(axis, *v) * std::sin(angle) +
                 axis * glm::dot(axis, *v) * (1 - std::cos(angle));
        }
    }
};

double signOf(double x) { return x < 0 ? -1 : 1; }

Frame firstFrame(int a, int b) {
    const double p = a / 32767.0, q = b / 32767.0;
    const bool rear = std::abs(a) + std::abs(b) > 32767;
    const glm::dvec3 d = glm::normalize(
        rear ? glm::dvec3(1 - std::abs(p) - std::abs(q), signOf(p) * (1 - std::abs(q)), signOf(q) * (1 - std::abs(p)))
             : glm::dvec3(1 - std::abs(p) - std::abs(q), p, q));
    Frame frame{{rear ? -1 : 1, 0, 0}, {0, rear ? -1 : 1, 0}, {0, 0, 1}};
    const glm::dvec3 axis = glm::cross(frame.forward, d);
    const double sine = glm::length(axis);
    if (sine > 0) frame.rotate(axis / sine, std::atan2(sine, glm::dot(frame.forward, d)));
    return frame;
}

/// Turns by a code: direction of the turn from the place on the square, its angle from the share of the cap's area.
void turn(Frame& frame, unsigned code, unsigned width, double ratio) {
    const unsigned side = 1U << (width / 2);
    const double q1 = 2.0 * (code % side) / (side - 1) - 1, q2 = 2.0 * (code / side) / (side - 1) - 1;
    const double y = (q1 + q2) / 2, z = (q1 - q2) / 2, x = 1 - std::abs(y) - std::abs(z);
    const double share = 1 - x / std::sqrt(x * x + y * y + z * z);  // of the hemisphere's area, and so of the cap's
    const double angle = 2 * std::asin(std::sqrt(std::clamp(ratio * share / 2, 0.0, 1.0)));
    const double towards = std::atan2(z, y);
    const glm::dvec3 side_of_turn = std::cos(towards) * frame.left + std::sin(towards) * frame.up;
    frame.rotate(glm::normalize(glm::cross(frame.forward, side_of_turn)), angle);
}

}  // namespace

std::vector<glm::dvec3> fibletPoints(const std::array<std::uint32_t, 5>& head, std::span<const std::uint32_t> codes,
                                     double cell_mm, double step_mm, std::span<const float> cap_ratio) {
    Bits bits(head);
    const double cells[3] = {double(bits.take(20)), double(bits.take(20)), double(bits.take(20))};
    const double ratio = cap_ratio[bits.take(4)];
    const int a = std::int16_t(bits.take(16)), b = std::int16_t(bits.take(16));
    bits.take(32);  // the fibre
    const unsigned segments = bits.take(6), choice = bits.take(2);
    const unsigned width = choice == 3 ? 16 : 4 + 2 * choice;
    bits.take(1);
    const bool shortened = bits.take(1) == 1;

    Bits row(codes);
    Frame frame = firstFrame(a, b);
    std::vector<glm::dvec3> points{{cells[0] * cell_mm, cells[1] * cell_mm, cells[2] * cell_mm}};
    for (unsigned i = 1; i <= segments; ++i) {
        if (i > 1) turn(frame, row.take(width), width, ratio);
        const double length = i == segments && shortened ? step_mm * row.take(16) / 65535 : step_mm;
        points.push_back(points.back() + length * frame.forward);
    }
    return points;
}

}  // namespace radiata::reference
