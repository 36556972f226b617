#include "render/fiblet/fibre_measures.h"

#include "build/fiblet_code.h"

namespace radiata::render {
namespace {

/// 16 bits behind the codes of a fiblet: how much of its last segment there is.
double shortenedShare(const model::FibletSet& set, std::size_t fiblet) {
    const model::FibletHead& head = set.heads[fiblet];
    const std::uint64_t bit = std::uint64_t{model::fibletSegments(head) - 1} * model::fibletWidth(head);
    const std::size_t word = set.pages[fiblet / shader::FIBLET_PAGE].first_word + model::fibletWord(head) + bit / 32;
    const std::uint64_t two = set.codes[word] | std::uint64_t{set.codes[word + 1]} << 32;
    return static_cast<double>(two >> (bit % 32) & 0xffffU) / 65535;
}

double fibletLength(const model::FibletSet& set, std::size_t fiblet) {
    const model::FibletHead& head = set.heads[fiblet];
    double segments = model::fibletSegments(head);
    if (model::fibletIsShortened(head)) segments += shortenedShare(set, fiblet) - 1;
    return static_cast<double>(set.codec.step_mm) * segments;
}

}  // namespace

double fibreLength(const model::FibletSet& set, std::uint32_t fibre) {
    double length = 0;
    for (std::uint32_t i = set.fibre_first[fibre]; i < set.fibre_first[fibre + 1]; ++i) {
        length += fibletLength(set, set.fibre_fiblets[i]);
    }
    return length;
}

std::vector<float> fibreLengths(const model::FibletSet& set) {
    std::vector<double> lengths(set.fibres(), 0);
    for (std::size_t i = 0; i < set.heads.size(); ++i) lengths[set.heads[i].fibre] += fibletLength(set, i);
    return {lengths.begin(), lengths.end()};
}

FibreSegmentPlace segmentPlace(const model::FibletSet& set, std::uint32_t fiblet, std::uint32_t segment) {
    const model::FibletHead& head = set.heads[fiblet];
    const std::uint32_t first = set.pages[fiblet / shader::FIBLET_PAGE].first_word + model::fibletWord(head);
    glm::vec3 offsets[shader::FIBLET_SEGMENTS + 1];
    decodeOffsets(head, set.codes.data() + first, set.codec, offsets);
    const glm::dvec3 start = set.origin_mm + fibletStart(head, set.codec);
    return {start + glm::dvec3(offsets[segment]), start + glm::dvec3(offsets[segment + 1])};
}

}  // namespace radiata::render
