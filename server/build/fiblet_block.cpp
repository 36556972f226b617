#include "build/fiblet_block.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"

namespace radiata {
namespace {

using shader::FIBLET_SEGMENTS;

/// At the fiblet's points, rad.
float largestTurn(const FibletTargets& targets) {
    float least = 1;
    for (std::uint32_t i = 2; i <= targets.segments; ++i) {
        const glm::vec3 u = targets.points[i - 1] - targets.points[i - 2], v = targets.points[i] - targets.points[i - 1];
        const float square = glm::dot(u, u) * glm::dot(v, v);
        if (square > 0) least = std::min(least, glm::dot(u, v) / std::sqrt(square));
    }
    return std::acos(std::max(least, -1.0F));
}

void putValues(std::span<const float> values, std::vector<glm::vec2>& ranges, std::vector<std::uint8_t>& stored) {
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (const float v : values) {
        if (!std::isfinite(v)) continue;
        low = std::min(low, v);
        high = std::max(high, v);
    }
    if (low > high) low = high = 0;
    ranges.emplace_back(low, high);
    const std::size_t first = stored.size();
    stored.resize(first + 64, 255);
    const double scale = high > low ? 254 / (double(high) - low) : 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isfinite(values[i])) stored[first + i] = std::uint8_t(std::lround((double(values[i]) - low) * scale));
    }
}

}  // namespace

void FibletBlock::append(const FibletBlock& block) {
    for (LooseFiblet fiblet : block.fiblets) {
        fiblet.first_word += heap.size();
        fiblets.push_back(fiblet);
    }
    heap.insert(heap.end(), block.heap.begin(), block.heap.end());
    for (std::size_t c = 0; c < block.ranges.size(); ++c) {
        ranges[c].insert(ranges[c].end(), block.ranges[c].begin(), block.ranges[c].end());
        values[c].insert(values[c].end(), block.values[c].begin(), block.values[c].end());
    }
    sum_error_nm += block.sum_error_nm;
    max_error_mm = std::max(max_error_mm, block.max_error_mm);
    points += block.points;
    measured += block.measured;
}

model::FibletErrors FibletBlock::errors() const {
    return {measured > 0 ? 1e-3 * double(sum_error_nm) / double(measured) : 0, 1e3 * max_error_mm, measured};
}

FibletEncoder::FibletEncoder(const FibletPlan& plan, const FibletOptions& options)
    : tables_(plan.set.codec, float(options.bound_um * 1e-3)),
      origin_mm_(plan.set.origin_mm),
      options_(options),
      source_(plan.set.source),
      bound_mm_(float(options.bound_um * 1e-3)),
      walked_(plan.set.walked) {}

void FibletEncoder::encode(std::span<const glm::vec3> points, std::span<const std::vector<float>> values, std::uint64_t number,
                           FibletBlock& block) const {
    const std::uint64_t segments = points.size() - 1;
    const std::uint64_t count = std::max<std::uint64_t>(1, (segments + FIBLET_SEGMENTS - 1) / FIBLET_SEGMENTS);
    if (count > model::kFibletsPerFibre) {
        throw Error(Code::kInvalidArgument, source_ + ": fibre " + std::to_string(number) + " has " +
                                                std::to_string(points.size()) + " points; fiblets hold at most " +
                                                std::to_string(FIBLET_SEGMENTS * model::kFibletsPerFibre + 1) + " per fibre");
    }
    block.points += points.size();
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t begin = i * FIBLET_SEGMENTS, size = std::min(segments, begin + FIBLET_SEGMENTS) - begin + 1;
        model::FibletParts parts;
        parts.fibre = std::uint32_t(number);
        parts.index = std::uint32_t(i);
        parts.last = i + 1 == count;
        encodePart(points.subspan(begin, size), parts, block);
        for (std::size_t c = 0; c < values.size(); ++c)
            putValues(std::span(values[c]).subspan(begin, size), block.ranges[c], block.values[c]);
    }
}

void FibletEncoder::encodePart(std::span<const glm::vec3> points, model::FibletParts& parts, FibletBlock& block) const {
    const shader::FibletCodec& codec = tables_.codec();
    const glm::dvec3 place = (glm::dvec3(points[0]) - origin_mm_) / double(codec.cell_mm);
    parts.cell = glm::uvec3(glm::clamp(glm::round(place), glm::dvec3(0), glm::dvec3(model::kFibletCellMax)));
    const glm::dvec3 start = origin_mm_ + glm::dvec3(parts.cell) * double(codec.cell_mm);
    FibletTargets targets;
    targets.segments = parts.segments = std::uint32_t(points.size() - 1);
    for (std::size_t i = 0; i < points.size(); ++i) targets.points[i] = glm::vec3(glm::dvec3(points[i]) - start);
    targets.last_length_mm = codec.step_mm;
    std::uint32_t tail = 0;
    if (parts.last && parts.segments > 0) {
        const double share =
            double(glm::distance(targets.points[parts.segments], targets.points[parts.segments - 1])) / double(codec.step_mm);
        if (share < 0.99) {
            tail = std::uint32_t(std::lround(share * 65535));
            targets.last_length_mm = codec.step_mm * (float(tail) / 65535.0F);
            parts.shortened = true;
        }
    }
    put(choose(targets, parts.fibre), targets, tail, parts, block);
}

/// The narrowest codes that hold the bound. What the settings asked for cannot hold is searched for with more care.
FibletPiece FibletEncoder::choose(const FibletTargets& targets, std::uint64_t fibre) const {
    const float turn = largestTurn(targets);
    FibletPiece best;
    best.max_error_mm = std::numeric_limits<float>::infinity();
    search(targets, turn, options_.beam, best);
    for (const std::uint32_t beam : {kBeamUsual, kBeamMax}) {
        if (best.max_error_mm <= bound_mm_) return best;
        if (beam > options_.beam) search(targets, turn, beam, best);
    }
    if (best.max_error_mm > bound_mm_) searchAllCaps(targets, kBeamMax, best);
    if (best.max_error_mm <= bound_mm_) return best;
    throw UnheldBound(source_ + ": fibre " + std::to_string(fibre) + " cannot be encoded within " +
                          std::to_string(options_.bound_um) + " um: with steps of " + std::to_string(tables_.codec().step_mm) +
                          " mm and places in cells of " + std::to_string(tables_.codec().cell_mm) +
                          " mm the least error found is " + std::to_string(1e3F * best.max_error_mm) +
                          " um; allow that much (radiata-convert --bound), or set points anew with a smaller step (--step)",
                      tables_.codec().step_mm, walked_);
}

/// Other caps are tried where the first misses the bound by little.
void FibletEncoder::search(const FibletTargets& targets, float turn, std::uint32_t beam, FibletPiece& best) const {
    const auto attempt = [&](std::uint32_t choice, std::uint32_t cap) {
        const FibletPiece piece =
            beam > 0 ? encodeBeam(targets, choice, cap, tables_, beam) : encodeGreedy(targets, choice, cap, tables_);
        if (piece.max_error_mm < best.max_error_mm) best = piece;
        return piece.max_error_mm;
    };
    const auto widest = std::uint32_t(model::kFibletWidths.size() - 1);
    for (std::uint32_t choice = 0; choice <= widest; ++choice) {
        if (model::kFibletWidths[choice] < options_.least_width) continue;
        const std::uint32_t cap = tables_.bestCap(turn, choice, beam > 0);
        const float first = attempt(choice, cap);
        if (first > bound_mm_ && (first < 1.6F * bound_mm_ || choice == widest)) {
            for (int other = int(cap) - 1; other >= std::max(int(cap) - 3, 0) && best.max_error_mm > bound_mm_; --other) {
                attempt(choice, std::uint32_t(other));
            }
            if (cap + 1 < shader::FIBLET_CAPS && best.max_error_mm > bound_mm_) attempt(choice, cap + 1);
        }
        if (best.max_error_mm <= bound_mm_) return;
    }
}

/// One sharp turn widens the cap that suits it for all the others: the error may be least under a cap far from that.
void FibletEncoder::searchAllCaps(const FibletTargets& targets, std::uint32_t beam, FibletPiece& best) const {
    const auto widest = std::uint32_t(model::kFibletWidths.size() - 1);
    for (std::uint32_t cap = 0; cap < shader::FIBLET_CAPS && best.max_error_mm > bound_mm_; ++cap) {
        const FibletPiece piece = encodeBeam(targets, widest, cap, tables_, beam);
        if (piece.max_error_mm < best.max_error_mm) best = piece;
    }
}

void FibletEncoder::put(const FibletPiece& piece, const FibletTargets& targets, std::uint32_t tail, model::FibletParts& parts,
                        FibletBlock& block) const {
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
    block.sum_error_nm += std::uint64_t(std::llround(1e6 * piece.sum_error_mm));
    block.max_error_mm = std::max(block.max_error_mm, double(piece.max_error_mm));
    block.measured += targets.segments + 1;
}

}  // namespace radiata
