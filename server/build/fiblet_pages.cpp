#include "build/fiblet_pages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "base/error.h"
#include "base/parallel.h"
#include "build/fiblet_code.h"

namespace radiata {
namespace {

using shader::FIBLET_PAGE;

/// Spreads the lower 20 bits so that two free bits lie between each two.
std::uint64_t spread(std::uint64_t x) {
    x = (x | x << 32) & 0x1f00000000ffffULL;
    x = (x | x << 16) & 0x1f0000ff0000ffULL;
    x = (x | x << 8) & 0x100f00f00f00f00fULL;
    x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
    return (x | x << 2) & 0x1249249249249249ULL;
}

/// Code of the cell that the fiblet's middle point lies in.
std::uint64_t mortonCode(const model::FibletHead& head, const std::uint32_t* words, const shader::FibletCodec& codec) {
    std::array<glm::vec3, 64> points;
    const std::uint32_t count = decodeOffsets(head, words, codec, points.data());
    const glm::dvec3 middle = (fibletStart(head, codec) + glm::dvec3(points[count / 2])) / double(codec.cell_mm);
    const glm::dvec3 cell = glm::clamp(middle, glm::dvec3(0), glm::dvec3(model::kFibletCellMax));
    return spread(std::uint64_t(cell.x)) | spread(std::uint64_t(cell.y)) << 1 | spread(std::uint64_t(cell.z)) << 2;
}

struct Bounds {
    glm::vec3 low{std::numeric_limits<float>::max()}, high{std::numeric_limits<float>::lowest()};
    std::uint32_t diagonal = 0;  ///< bits as in shader::FibletBox
    float off = 0;               ///< largest distance of a point from that diagonal
};

/// The diagonal that points run along, and how far they are from it.
void findDiagonal(std::span<const glm::vec3> points, Bounds& box) {
    const glm::vec3 middle = 0.5F * (box.low + box.high);
    float xy = 0, xz = 0;
    for (const glm::vec3& point : points) {
        const glm::vec3 p = point - middle;
        xy += p.x * p.y;
        xz += p.x * p.z;
    }
    box.diagonal = (xy < 0 ? 1U : 0U) | (xz < 0 ? 2U : 0U);
    const glm::vec3 from(box.low.x, xy < 0 ? box.high.y : box.low.y, xz < 0 ? box.high.z : box.low.z);
    const glm::vec3 way = box.low + box.high - 2.0F * from;
    const float length2 = glm::dot(way, way);
    for (const glm::vec3& point : points) {
        const float share = length2 > 0 ? std::clamp(glm::dot(point - from, way) / length2, 0.0F, 1.0F) : 0;
        box.off = std::max(box.off, glm::distance(point, from + share * way));
    }
}

/// As the device unpacks it.
glm::vec3 unpacked(std::uint32_t bits, const shader::FibletPage& page) {
    const glm::vec3 whole(bits & 1023U, bits >> 10 & 1023U, bits >> 20 & 1023U);
    return page.low + whole / static_cast<float>(shader::FIBLET_BOX_STEPS) * (page.high - page.low);
}

/// The upper bits of a box: its diagonal, and how far points are from it in parts of its length.
void addDiagonal(shader::FibletBox& packed, const Bounds& box, const shader::FibletPage& page) {
    const glm::vec3 low = unpacked(packed.low, page), high = unpacked(packed.high, page);
    // The diagonal is that of the unpacked box, whose corners are a little farther out.
    const float off = box.off + glm::length(glm::max(box.low - low, high - box.high)) + 1e-3F;
    const float length = glm::distance(low, high);
    std::uint32_t n = 0;
    while (n < 3 && off <= length * std::exp2(-static_cast<float>(n + 3))) ++n;
    packed.low |= box.diagonal << 30;
    packed.high |= n << 30;
}

/// One step outwards of three coordinates in steps of the page's box.
std::uint32_t steps(glm::vec3 p, const shader::FibletPage& page, bool upwards) {
    std::uint32_t packed = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double extent = double(page.high[axis]) - page.low[axis];
        const double t = extent > 0 ? (double(p[axis]) - page.low[axis]) / extent * shader::FIBLET_BOX_STEPS : upwards ? 1 : 0;
        // A thousandth of a step covers the rounding of whoever unpacks in float32.
        const double whole =
            std::clamp(upwards ? std::ceil(t + 1e-3) : std::floor(t - 1e-3), 0.0, double(shader::FIBLET_BOX_STEPS));
        packed |= std::uint32_t(whole) << (10 * axis);
    }
    return packed;
}

void boundPage(model::FibletSet& set, std::size_t p) {
    // Of decoders in float32: rounding of 63 sums at 200 mm stays below this.
    constexpr float kSlackMm = 2e-4F;
    shader::FibletPage& page = set.pages[p];
    std::array<Bounds, FIBLET_PAGE> boxes;
    std::array<glm::vec3, 64> points;
    Bounds all;
    for (std::uint32_t f = 0; f < page.count; ++f) {
        const model::FibletHead& head = set.heads[p * FIBLET_PAGE + f];
        const std::uint32_t count =
            decodeOffsets(head, set.codes.data() + page.first_word + model::fibletWord(head), set.codec, points.data());
        const glm::vec3 start(fibletStart(head, set.codec));
        for (std::uint32_t i = 0; i < count; ++i) {
            boxes[f].low = glm::min(boxes[f].low, points[i]);
            boxes[f].high = glm::max(boxes[f].high, points[i]);
        }
        findDiagonal(std::span(points).first(count), boxes[f]);
        boxes[f].low += start - kSlackMm;
        boxes[f].high += start + kSlackMm;
        all.low = glm::min(all.low, boxes[f].low);
        all.high = glm::max(all.high, boxes[f].high);
    }
    page.low = all.low;
    page.high = all.high;
    for (std::uint32_t f = 0; f < page.count; ++f) {
        set.boxes[p * FIBLET_PAGE + f] = {steps(boxes[f].low, page, false), steps(boxes[f].high, page, true)};
        addDiagonal(set.boxes[p * FIBLET_PAGE + f], boxes[f], page);
    }
}

}  // namespace

void requireFibletRoom(std::uint64_t fiblets, std::uint64_t words, const std::string& source) {
    if (fiblets < 0xffffffffULL && words < 0xffffffffULL) return;
    throw Error(Code::kResourceExhausted,
                source + ": takes " + std::to_string(fiblets) + " fiblets with " + std::to_string(words) +
                    " words of codes; fewer than 2^32 of each can be numbered: divide the tractogram");
}

void boundFiblets(model::FibletSet& set) {
    set.boxes.resize(set.heads.size());
    parallelFor(set.pages.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) boundPage(set, p);
    });
}

void indexFibres(model::FibletSet& set, std::uint64_t fibres) {
    set.fibre_first.assign(fibres + 1, 0);
    for (const model::FibletHead& head : set.heads) ++set.fibre_first[head.fibre + 1];
    std::partial_sum(set.fibre_first.begin(), set.fibre_first.end(), set.fibre_first.begin());
    set.fibre_fiblets.resize(set.heads.size());
    for (std::uint32_t i = 0; i < set.heads.size(); ++i) {
        set.fibre_fiblets[set.fibre_first[set.heads[i].fibre] + model::fibletIndex(set.heads[i])] = i;
    }
}

std::vector<OrderedFiblet> orderFiblets(const std::vector<LooseFiblet>& fiblets, const std::vector<std::uint32_t>& heap,
                                        const shader::FibletCodec& codec) {
    std::vector<OrderedFiblet> order(fiblets.size());
    parallelFor(fiblets.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            order[i] = {mortonCode(fiblets[i].head, heap.data() + fiblets[i].first_word, codec), std::uint32_t(i)};
        }
    });
    std::sort(order.begin(), order.end());
    return order;
}

void appendFiblet(model::FibletSet& set, model::FibletHead head, const std::uint32_t* words) {
    if (set.heads.size() % FIBLET_PAGE == 0)
        set.pages.push_back({glm::vec3(0), std::uint32_t(set.codes.size()), glm::vec3(0), 0});
    shader::FibletPage& page = set.pages.back();
    ++page.count;
    const auto place = std::uint32_t(set.codes.size()) - page.first_word;
    head.shape = (head.shape & ~(1023U << 10)) | (place / 2) << 10;
    set.heads.push_back(head);
    set.codes.insert(set.codes.end(), words, words + wordsOf(head));
}

std::vector<std::uint32_t> arrangeFiblets(model::FibletSet& set, const std::vector<LooseFiblet>& fiblets,
                                          const std::vector<std::uint32_t>& heap, std::uint64_t fibres) {
    requireFibletRoom(fiblets.size(), heap.size(), set.source);
    const std::vector<OrderedFiblet> order = orderFiblets(fiblets, heap, set.codec);
    set.heads.clear();
    set.codes.clear();
    set.pages.clear();
    set.heads.reserve(fiblets.size());
    set.codes.reserve(heap.size() + 1);
    for (const OrderedFiblet& next : order) {
        const LooseFiblet& fiblet = fiblets[next.number];
        appendFiblet(set, fiblet.head, heap.data() + fiblet.first_word);
    }
    set.codes.push_back(0);
    indexFibres(set, fibres);
    boundFiblets(set);
    std::vector<std::uint32_t> numbers(order.size());
    std::transform(order.begin(), order.end(), numbers.begin(), [](const auto& each) { return each.number; });
    return numbers;
}

}  // namespace radiata
