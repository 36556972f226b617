#include "build/fiblet_encode.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "build/fiblet_code.h"
#include "build/fiblet_pages.h"
#include "build/fiblet_piece.h"

namespace radiata {
namespace {

using shader::FIBLET_SEGMENTS;

/// A block of fibres, encoded.
struct Block {
    std::vector<LooseFiblet> fiblets;
    std::vector<std::uint32_t> heap;
    double sum_error_mm = 0, max_error_mm = 0;
    std::uint64_t points = 0, measured = 0;
};

class Encoder {
public:
    Encoder(const model::FibletSet& set, const FibletOptions& options)
        : set_(set), options_(options), bound_mm_(float(options.bound_um * 1e-3)) {}

    void encode(std::span<const glm::vec3> fibre, std::uint64_t number, Block& block) const {
        const std::uint64_t segments = fibre.size() - 1,
                            count = std::max<std::uint64_t>(1, (segments + FIBLET_SEGMENTS - 1) / FIBLET_SEGMENTS);
        if (count > model::kFibletsPerFibre) {
            throw Error(Code::kInvalidArgument,
                        name(number) + " has " + std::to_string(fibre.size()) + " points; a set of fiblets holds at most " +
                            std::to_string(FIBLET_SEGMENTS * model::kFibletsPerFibre + 1) + " per fibre");
        }
        block.points += fibre.size();
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint64_t begin = i * FIBLET_SEGMENTS, end = std::min(segments, begin + FIBLET_SEGMENTS);
            model::FibletParts parts;
            parts.fibre = std::uint32_t(number);
            parts.index = std::uint32_t(i);
            parts.last = i + 1 == count;
            encodePart(fibre.subspan(begin, end - begin + 1), parts, block);
        }
    }

    std::string name(std::uint64_t fibre) const { return options_.source + ": fibre " + std::to_string(fibre); }

private:
    void encodePart(std::span<const glm::vec3> points, model::FibletParts& parts, Block& block) const {
        const glm::dvec3 place = (glm::dvec3(points[0]) - set_.origin_mm) / double(set_.codec.cell_mm);
        parts.cell = glm::uvec3(glm::clamp(glm::round(place), glm::dvec3(0), glm::dvec3(model::kFibletCellMax)));
        const glm::dvec3 start = set_.origin_mm + glm::dvec3(parts.cell) * double(set_.codec.cell_mm);
        FibletTargets targets;
        targets.segments = parts.segments = std::uint32_t(points.size() - 1);
        for (std::size_t i = 0; i < points.size(); ++i) targets.points[i] = glm::vec3(glm::dvec3(points[i]) - start);
        targets.last_length_mm = set_.codec.step_mm;
        std::uint32_t tail = 0;
        if (parts.last && parts.segments > 0) {
            const double length = glm::distance(glm::dvec3(points[points.size() - 1]), glm::dvec3(points[points.size() - 2]));
            if (length < 0.99 * double(set_.codec.step_mm)) {
                tail = std::uint32_t(std::lround(length / double(set_.codec.step_mm) * 65535));
                targets.last_length_mm = set_.codec.step_mm * (float(tail) / 65535.0F);
                parts.shortened = true;
            }
        }
        put(choose(targets, parts.fibre), targets, tail, parts, block);
    }

    /// The narrowest codes that hold the bound, under the cap with the smallest error.
    FibletPiece choose(const FibletTargets& targets, std::uint64_t fibre) const {
        std::optional<FibletPiece> best;
        for (std::uint32_t choice = 0; choice < model::kFibletWidths.size(); ++choice) {
            for (std::uint32_t cap = 0; cap < shader::FIBLET_CAPS; ++cap) {
                const FibletPiece piece = encodeGreedy(targets, choice, cap, set_.codec);
                if (!best || piece.max_error_mm < best->max_error_mm) best = piece;
            }
            if (best->max_error_mm <= bound_mm_) return *best;
        }
        throw Error(Code::kInvalidArgument, name(fibre) + " cannot be encoded within " + std::to_string(options_.bound_um) +
                                                " um: with steps of " + std::to_string(set_.codec.step_mm) +
                                                " mm the least error found is " + std::to_string(1e3F * best->max_error_mm) +
                                                " um; allow that much");
    }

    void put(const FibletPiece& piece, const FibletTargets& targets, std::uint32_t tail, model::FibletParts& parts,
             Block& block) const {
        parts.cap = piece.cap;
        parts.direction = piece.direction;
        parts.width_choice = piece.width_choice;
        const std::uint32_t width = model::kFibletWidths[piece.width_choice];
        const std::uint32_t words = model::fibletWords(parts.segments, width, parts.shortened);
        block.fiblets.push_back({model::packHead(parts), block.heap.size()});
        block.heap.resize(block.heap.size() + words, 0);
        const std::span<std::uint32_t> own = std::span(block.heap).last(words);
        for (std::uint32_t i = 0; i + 1 < parts.segments; ++i) putBits(own, i * width, width, piece.codes[i]);
        if (parts.shortened) putBits(own, (parts.segments - 1) * width, 16, tail);
        block.sum_error_mm += piece.sum_error_mm;
        block.max_error_mm = std::max(block.max_error_mm, double(piece.max_error_mm));
        block.measured += targets.segments + 1;
    }

    const model::FibletSet& set_;
    const FibletOptions& options_;
    float bound_mm_;
};

/// Cells, step and caps for the points. \throws Error(kInvalidArgument) for a point that is not finite
void measure(std::span<const glm::vec3> points, std::span<const std::uint64_t> offsets, const FibletOptions& options,
             model::FibletSet& set) {
    glm::dvec3 low(0), high(0);
    double length = 0;
    std::uint64_t segments = 0;
    for (std::size_t f = 0; f + 1 < offsets.size(); ++f) {
        for (std::uint64_t i = offsets[f]; i < offsets[f + 1]; ++i) {
            const glm::dvec3 p(points[i]);
            if (!std::isfinite(p.x + p.y + p.z)) {
                throw Error(Code::kInvalidArgument, options.source + ": point " + std::to_string(i - offsets[f]) +
                                                        " of fibre " + std::to_string(f) + " is not finite");
            }
            low = i == 0 ? p : glm::min(low, p);
            high = i == 0 ? p : glm::max(high, p);
            if (i > offsets[f] && (i + 1 < offsets[f + 1] || i == offsets[f] + 1)) {
                length += glm::distance(p, glm::dvec3(points[i - 1]));
                ++segments;
            }
        }
    }
    const glm::dvec3 size = high - low;
    const double step = options.step_mm > 0 ? options.step_mm : segments > 0 ? length / double(segments) : 0;
    set.codec.step_mm = float(step > 0 ? step : 1);
    set.origin_mm = low;
    set.codec.cell_mm = float(std::max(std::max({size.x, size.y, size.z}) / model::kFibletCellMax, 1e-6) * (1 + 1e-6));
    for (std::uint32_t i = 0; i < shader::FIBLET_CAPS; ++i) {
        set.codec.cap_ratio[i] = float(1 - std::cos(3.14159265358979 * std::exp2(-0.5 * i)));
    }
}

}  // namespace

model::FibletSet encodeFiblets(std::span<const glm::vec3> points, std::span<const std::uint64_t> offsets,
                               const FibletOptions& options) {
    model::FibletSet set;
    set.source = options.source;
    set.bound_um = options.bound_um;
    measure(points, offsets, options, set);
    const Encoder encoder(set, options);
    const std::size_t fibres = offsets.size() - 1, block_size = 16;
    std::vector<Block> blocks((fibres + block_size - 1) / block_size);
    parallelFor(fibres, block_size, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            if (offsets[f + 1] > offsets[f])
                encoder.encode(points.subspan(offsets[f], offsets[f + 1] - offsets[f]), f, blocks[begin / block_size]);
        }
    });
    std::vector<LooseFiblet> fiblets;
    std::vector<std::uint32_t> heap;
    double sum_mm = 0, max_mm = 0;
    for (Block& block : blocks) {
        for (LooseFiblet& fiblet : block.fiblets) {
            fiblet.first_word += heap.size();
            fiblets.push_back(fiblet);
        }
        heap.insert(heap.end(), block.heap.begin(), block.heap.end());
        sum_mm += block.sum_error_mm;
        max_mm = std::max(max_mm, block.max_error_mm);
        set.points += block.points;
        set.errors.points += block.measured;
    }
    set.errors.mean_um = set.errors.points > 0 ? 1e3 * sum_mm / double(set.errors.points) : 0;
    set.errors.max_um = 1e3 * max_mm;
    arrangeFiblets(set, fiblets, heap, fibres);
    return set;
}

}  // namespace radiata
