#include "render/fiblet/fibre_vertices.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "build/fiblet_code.h"
#include "gpu/device.h"
#include "shaders/shared/fiblet_draw.glsl"

namespace radiata::render {
namespace {

/// Fibres that are decoded before they are sent.
constexpr std::size_t kFibresAtOnce = 16'384;

std::uint32_t segmentsOf(const model::FibletSet& set, std::size_t fibre) {
    std::uint32_t segments = 0;
    for (std::uint32_t i = set.fibre_first[fibre]; i < set.fibre_first[fibre + 1]; ++i) {
        segments += model::fibletSegments(set.heads[set.fibre_fiblets[i]]);
    }
    return segments;
}

void decode(const model::FibletSet& set, std::size_t fibre, shader::FibreVertex* to) {
    glm::vec3 offsets[shader::FIBLET_SEGMENTS + 1];
    for (std::uint32_t i = set.fibre_first[fibre]; i < set.fibre_first[fibre + 1]; ++i) {
        const std::uint32_t fiblet = set.fibre_fiblets[i];
        const model::FibletHead& head = set.heads[fiblet];
        const std::uint32_t word = set.pages[fiblet / shader::FIBLET_PAGE].first_word + model::fibletWord(head);
        decodeOffsets(head, set.codes.data() + word, set.codec, offsets);
        const glm::vec3 start(fibletStart(head, set.codec));
        const std::uint32_t segments = model::fibletSegments(head);
        for (std::uint32_t s = 0; s < segments; ++s) *to++ = {start + offsets[s], fiblet << shader::FIBLET_SEGMENT_BITS | s};
        if (i + 1 == set.fibre_first[fibre + 1]) {
            *to = {start + offsets[segments], fiblet << shader::FIBLET_SEGMENT_BITS | (segments - 1)};
        }
    }
}

template <typename T>
gpu::Buffer uploaded(gpu::Device& device, const std::vector<T>& values, const char* name) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
    gpu::Buffer buffer(device, std::max<std::size_t>(bytes.size(), 16), gpu::Memory::kDevice, name);
    if (!bytes.empty()) gpu::upload(device, buffer, 0, bytes);
    return buffer;
}

}  // namespace

FibreVertices::FibreVertices(gpu::Device& device, const model::FibletSet& set) {
    std::vector<std::size_t> fibres;
    std::vector<std::uint32_t> fibre_first;
    std::uint64_t points = 0;
    for (std::size_t f = 0; f < set.fibres(); ++f) {
        const std::uint32_t segments = segmentsOf(set, f);
        fibre_first.push_back(first_.back());
        if (segments == 0) continue;
        points += segments + 1;
        if (points >= std::numeric_limits<std::uint32_t>::max()) {
            throw Error(Code::kUnsupported, set.source + " has 2^32 points or more; uncompressed, fewer can be drawn");
        }
        fibres.push_back(f);
        first_.push_back(static_cast<std::uint32_t>(points));
    }
    // One more, as each vertex is read together with the next.
    vertices_ = gpu::Buffer(device, (points + 1) * sizeof(shader::FibreVertex), gpu::Memory::kDevice, "fibre vertices");
    std::vector<shader::FibreVertex> part;
    for (std::size_t begin = 0; begin < fibres.size(); begin += kFibresAtOnce) {
        const std::size_t end = std::min(fibres.size(), begin + kFibresAtOnce);
        part.resize(first_[end] - first_[begin]);
        parallelFor(end - begin, 256, [&](std::size_t from, std::size_t to) {
            for (std::size_t i = begin + from; i < begin + to; ++i) {
                decode(set, fibres[i], part.data() + (first_[i] - first_[begin]));
            }
        });
        gpu::upload(device, vertices_, first_[begin] * sizeof(shader::FibreVertex), std::as_bytes(std::span(part)));
    }
    std::vector<std::array<std::uint32_t, 4>> draws;
    for (std::size_t i = 0; i < fibres.size(); ++i) draws.push_back({first_[i + 1] - first_[i], 1, first_[i], 0});
    commands_ = uploaded(device, draws, "fibre draws");
    fibre_first_ = uploaded(device, fibre_first, "first vertices of fibres");
}

}  // namespace radiata::render
