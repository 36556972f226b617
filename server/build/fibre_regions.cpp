#include "build/fibre_regions.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "base/parallel.h"
#include "build/fiblet_code.h"

namespace radiata {
namespace {

constexpr std::size_t kPagesPerBlock = 16;

class Marker {
public:
    Marker(const model::FibletSet& set, const RegionVolume& region) : set_(set), region_(region), flags_(set.fibres()) {}

    void markPage(std::size_t p) {
        const shader::FibletPage& page = set_.pages[p];
        const glm::dvec3 low = set_.origin_mm + glm::dvec3(page.low), high = set_.origin_mm + glm::dvec3(page.high);
        const BoxRelation relation = region_.relate(low, high);
        const std::size_t first = p * shader::FIBLET_PAGE;
        for (std::size_t h = first; h < first + page.count; ++h) {
            if (relation == BoxRelation::kUnknown) {
                markFiblet(page, h);
            } else {
                markWhole(set_.heads[h], relation);
            }
        }
    }

    std::vector<std::uint8_t> take() { return std::move(flags_); }

private:
    /// All fiblets of a fibre write here, from any thread.
    void mark(std::uint32_t fibre, unsigned flags) {
        std::atomic_ref<std::uint8_t> shared(flags_[fibre]);
        if ((shared.load(std::memory_order_relaxed) & flags) != flags) {
            shared.fetch_or(static_cast<std::uint8_t>(flags), std::memory_order_relaxed);
        }
    }

    void markWhole(const model::FibletHead& head, BoxRelation relation) {
        if (relation == BoxRelation::kOutside) return mark(head.fibre, kLeaves);
        mark(head.fibre, kMeets | (model::fibletIndex(head) == 0 ? kFirstEnd : 0) | (model::fibletIsLast(head) ? kLastEnd : 0));
    }

    void markFiblet(const shader::FibletPage& page, std::size_t h) {
        const model::FibletHead& head = set_.heads[h];
        if (!set_.boxes.empty()) {
            const glm::dvec3 base = set_.origin_mm + glm::dvec3(page.low);
            const glm::dvec3 step = (glm::dvec3(page.high) - glm::dvec3(page.low)) / double(shader::FIBLET_BOX_STEPS);
            const auto corner = [&](std::uint32_t bits) {
                return base + step * glm::dvec3(bits & 1023U, bits >> 10 & 1023U, bits >> 20 & 1023U);
            };
            // The device unpacks in float; a thousandth of a millimetre covers what that rounds.
            const BoxRelation relation = region_.relate(corner(set_.boxes[h].low) - 1e-3, corner(set_.boxes[h].high) + 1e-3);
            if (relation != BoxRelation::kUnknown) return markWhole(head, relation);
        }
        markSegments(page, head);
    }

    void markSegments(const shader::FibletPage& page, const model::FibletHead& head) {
        std::array<glm::vec3, 64> offsets;
        const std::uint32_t* words = set_.codes.data() + page.first_word + model::fibletWord(head);
        const std::uint32_t count = decodeOffsets(head, words, set_.codec, offsets.data());
        const glm::dvec3 start = set_.origin_mm + fibletStart(head, set_.codec);
        glm::dvec3 a = start + glm::dvec3(offsets[0]);
        unsigned flags = region_.contains(a) ? kMeets : kLeaves;
        if (model::fibletIndex(head) == 0 && flags == kMeets) flags |= kFirstEnd;
        for (std::uint32_t i = 1; i < count; ++i) {
            const glm::dvec3 b = start + glm::dvec3(offsets[i]);
            if ((flags & kMeets) == 0 && region_.meets(a, b)) flags |= kMeets;
            if ((flags & kLeaves) == 0 && !region_.holds(a, b)) flags |= kLeaves;
            a = b;
        }
        if (model::fibletIsLast(head) && region_.contains(a)) flags |= kLastEnd;
        mark(head.fibre, flags);
    }

    const model::FibletSet& set_;
    const RegionVolume& region_;
    std::vector<std::uint8_t> flags_;
};

/// The regions one after another along the points as they stand.
template <typename Point>
bool inOrder(std::size_t count, Point&& point, std::span<const std::unique_ptr<RegionVolume>> regions) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < std::max<std::size_t>(count, 2) - 1 && next < regions.size(); ++i) {
        const glm::dvec3 a = point(i), b = point(std::min(i + 1, count - 1));
        while (next < regions.size() && regions[next]->meets(a, b)) ++next;
    }
    return next == regions.size();
}

}  // namespace

std::vector<std::uint8_t> fibreRegionFlags(const model::FibletSet& set, const RegionVolume& region) {
    Marker marker(set, region);
    parallelFor(set.pages.size(), kPagesPerBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) marker.markPage(p);
    });
    return marker.take();
}

bool meetsInOrder(std::span<const glm::dvec3> points, std::span<const std::unique_ptr<RegionVolume>> regions) {
    if (points.empty()) return false;
    return inOrder(
               points.size(), [&](std::size_t i) { return points[i]; }, regions) ||
           inOrder(
               points.size(), [&](std::size_t i) { return points[points.size() - 1 - i]; }, regions);
}

std::vector<float> fibreLengths(const model::FibletSet& set) {
    std::vector<float> lengths(set.fibres());
    parallelFor(set.fibres(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            double length = 0;
            for (std::uint32_t i = set.fibre_first[f]; i < set.fibre_first[f + 1]; ++i) {
                const std::uint32_t h = set.fibre_fiblets[i];
                const model::FibletHead& head = set.heads[h];
                const std::uint32_t segments = model::fibletSegments(head);
                double last = 1;
                if (segments > 0 && model::fibletIsShortened(head)) {
                    const std::uint32_t* words =
                        set.codes.data() + set.pages[h / shader::FIBLET_PAGE].first_word + model::fibletWord(head);
                    last = getBits(words, (segments - 1) * model::fibletWidth(head), 16) / 65535.0;
                }
                if (segments > 0) length += (segments - 1 + last) * static_cast<double>(set.codec.step_mm);
            }
            lengths[f] = static_cast<float>(length);
        }
    });
    return lengths;
}

}  // namespace radiata
