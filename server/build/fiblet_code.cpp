#include "build/fiblet_code.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace radiata {

glm::vec3 intoFrame(const Turn& q, glm::vec3 v) {
    const glm::vec3 u(-q.x, -q.y, -q.z);
    const glm::vec3 t = 2.0F * glm::cross(u, v);
    return v + q.w * t + glm::cross(u, t);
}

Turn codeTurn(std::uint32_t code, std::uint32_t width, float ratio) {
    const std::uint32_t half = width / 2;
    const int side = (1 << half) - 1;
    // Whole numbers: what lies on the cap's rim is exactly there, where the square root below is steep.
    const int a = 2 * int(code & std::uint32_t(side)) - side, b = 2 * int(code >> half) - side;
    const float wx = float(side - std::max(std::abs(a), std::abs(b))), wy = 0.5F * float(a + b), wz = 0.5F * float(a - b);
    const float length = std::sqrt(wx * wx + wy * wy + wz * wz), mx = wx / length;
    const float s = std::sqrt(0.5F * ratio / (1 + mx)) / length;
    return {std::sqrt((1 - 0.5F * ratio) + 0.5F * ratio * mx), 0, -s * wz, s * wy};
}

std::uint32_t nearestCode(glm::vec3 v, std::uint32_t width, float ratio) {
    const std::uint32_t half = width / 2;
    const float side = float((1U << half) - 1), length = glm::length(v);
    const float c = std::clamp(1 - (1 - v.x / length) / ratio, 0.0F, 1.0F);
    const float across = std::hypot(v.y, v.z), sine = std::sqrt(std::max(1 - c * c, 0.0F));
    const float my = across > 0 ? sine * v.y / across : sine, mz = across > 0 ? sine * v.z / across : 0;
    const float sum = c + std::abs(my) + std::abs(mz);
    const auto level = [&](float q) { return std::uint32_t(std::clamp(std::floor(0.5F + 0.5F * side * (1 + q)), 0.0F, side)); };
    return level((my + mz) / sum) | level((my - mz) / sum) << half;
}

glm::ivec2 packDirection(glm::dvec3 d) {
    const double sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    if (!(sum > 0)) return {0, 0};
    glm::dvec2 p(d.y / sum, d.z / sum);
    if (d.x < 0) p = {(p.x < 0 ? -1 : 1) * (1 - std::abs(d.z / sum)), (p.y < 0 ? -1 : 1) * (1 - std::abs(d.y / sum))};
    return {int(std::lround(p.x * 32767)), int(std::lround(p.y * 32767))};
}

Turn firstFrame(glm::ivec2 p) {
    const int x = 32767 - std::abs(p.x) - std::abs(p.y);
    if (x < 0) p = {(p.x < 0 ? -1 : 1) * (32767 - std::abs(p.y)), (p.y < 0 ? -1 : 1) * (32767 - std::abs(p.x))};
    const glm::vec3 d = glm::normalize(glm::vec3(x, p.x, p.y));
    const float w = std::sqrt(0.5F + 0.5F * std::abs(d.x));
    return x < 0 ? Turn{0.5F * d.y / w, 0.5F * d.z / w, 0, w} : Turn{w, 0, -0.5F * d.z / w, 0.5F * d.y / w};
}

void putBits(std::span<std::uint32_t> words, std::uint32_t bit, std::uint32_t width, std::uint32_t value) {
    const std::uint32_t word = bit / 32, shift = bit % 32;
    words[word] |= value << shift;
    if (shift + width > 32) words[word + 1] |= value >> (32 - shift);
}

std::uint32_t getBits(const std::uint32_t* words, std::uint32_t bit, std::uint32_t width) {
    const std::uint32_t word = bit / 32, shift = bit % 32;
    std::uint32_t value = words[word] >> shift;
    if (shift + width > 32) value |= words[word + 1] << (32 - shift);
    return value & ((1U << width) - 1);
}

std::uint32_t decodeOffsets(const model::FibletHead& head, const std::uint32_t* words, const shader::FibletCodec& codec,
                            glm::vec3* points) {
    const std::uint32_t segments = model::fibletSegments(head), width = model::fibletWidth(head);
    const float ratio = codec.cap_ratio[model::fibletCap(head)];
    Turn frame = firstFrame({std::int16_t(head.direction & 0xffffU), std::int16_t(head.direction >> 16)});
    points[0] = glm::vec3(0);
    for (std::uint32_t i = 1; i <= segments; ++i) {
        if (i > 1) frame = frame * codeTurn(getBits(words, (i - 2) * width, width), width, ratio);
        float length = codec.step_mm;
        if (i == segments && model::fibletIsShortened(head))
            length *= float(getBits(words, (segments - 1) * width, 16)) / 65535.0F;
        points[i] = points[i - 1] + length * axisOf(frame);
    }
    return segments + 1;
}

glm::dvec3 fibletStart(const model::FibletHead& head, const shader::FibletCodec& codec) {
    return glm::dvec3(model::fibletCell(head)) * double(codec.cell_mm);
}

std::vector<glm::dvec3> decodeFibre(const model::FibletSet& set, std::uint64_t fibre) {
    if (fibre >= set.fibres()) {
        throw Error(Code::kInvalidArgument,
                    set.source + ": there is no fibre " + std::to_string(fibre) + " among " + std::to_string(set.fibres()));
    }
    std::vector<glm::dvec3> points;
    glm::vec3 offsets[64];
    for (std::uint32_t i = set.fibre_first[fibre]; i < set.fibre_first[fibre + 1]; ++i) {
        const std::uint32_t fiblet = set.fibre_fiblets[i];
        const model::FibletHead& head = set.heads[fiblet];
        const std::uint32_t first = set.pages[fiblet / shader::FIBLET_PAGE].first_word + model::fibletWord(head);
        const std::uint32_t count = decodeOffsets(head, set.codes.data() + first, set.codec, offsets);
        const std::uint32_t used = model::fibletIsLast(head) ? count : count - 1;  // the next fiblet starts with the last point
        const glm::dvec3 start = set.origin_mm + fibletStart(head, set.codec);
        for (std::uint32_t k = 0; k < used; ++k) points.push_back(start + glm::dvec3(offsets[k]));
    }
    return points;
}

}  // namespace radiata
