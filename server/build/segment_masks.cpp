#include "build/segment_masks.h"

#include <array>

#include "base/parallel.h"
#include "build/fiblet_code.h"

namespace radiata {
namespace {

constexpr std::size_t kPagesPerBlock = 16, kFibletsPerBlock = 4096;

/// Bits of the segments whose middle is inside.
std::uint64_t insideBits(const model::FibletSet& set, const shader::FibletPage& page, const model::FibletHead& head,
                         const RegionVolume& region) {
    std::array<glm::vec3, 64> offsets;
    const std::uint32_t* words = set.codes.data() + page.first_word + model::fibletWord(head);
    const std::uint32_t count = decodeOffsets(head, words, set.codec, offsets.data());
    const glm::dvec3 start = set.origin_mm + fibletStart(head, set.codec);
    std::uint64_t bits = 0;
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
        const glm::dvec3 middle = start + 0.5 * (glm::dvec3(offsets[i]) + glm::dvec3(offsets[i + 1]));
        if (region.contains(middle)) bits |= std::uint64_t{1} << i;
    }
    return bits;
}

}  // namespace

void keepByRegion(const model::FibletSet& set, const RegionVolume& region, bool outside, SegmentMasks& masks) {
    const auto kept = [outside](std::uint64_t inside) { return outside ? ~inside : inside; };
    const auto page = [&](std::size_t p) {
        const shader::FibletPage& box = set.pages[p];
        const glm::dvec3 low = set.origin_mm + glm::dvec3(box.low), high = set.origin_mm + glm::dvec3(box.high);
        const BoxRelation whole = region.relate(low, high);
        const glm::dvec3 step = (high - low) / double(shader::FIBLET_BOX_STEPS);
        const auto corner = [&](std::uint32_t bits) {
            return low + step * glm::dvec3(bits & 1023U, bits >> 10 & 1023U, bits >> 20 & 1023U);
        };
        for (std::size_t f = p * shader::FIBLET_PAGE; f < p * shader::FIBLET_PAGE + box.count; ++f) {
            if (masks[f] == 0) continue;
            BoxRelation relation = whole;
            // The device unpacks boxes in float; a thousandth of a millimetre covers what that rounds.
            if (relation == BoxRelation::kUnknown && !set.boxes.empty()) {
                relation = region.relate(corner(set.boxes[f].low) - 1e-3, corner(set.boxes[f].high) + 1e-3);
            }
            std::uint64_t inside = relation == BoxRelation::kInside ? ~std::uint64_t{0} : 0;
            if (relation == BoxRelation::kUnknown) inside = insideBits(set, box, set.heads[f], region);
            masks[f] &= kept(inside);
        }
    };
    parallelFor(set.pages.size(), kPagesPerBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) page(p);
    });
}

void keepByValues(const model::FibletSet& set, const model::PointColumn& column, double low, double high, SegmentMasks& masks) {
    parallelFor(set.heads.size(), kFibletsPerBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const glm::dvec2 range(column.ranges[f]);
            std::uint64_t bits = 0;
            for (std::uint32_t i = 0; i < model::fibletSegments(set.heads[f]); ++i) {
                const std::uint32_t a = column.values[64 * f + i], b = column.values[64 * f + i + 1];
                const double value = range.x + (range.y - range.x) * (a + b) / 508.0;
                if (a < 255 && b < 255 && value >= low && value <= high) bits |= std::uint64_t{1} << i;
            }
            masks[f] &= bits;
        }
    });
}

}  // namespace radiata
