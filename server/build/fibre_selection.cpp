#include "build/fibre_selection.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "build/fiblet_code.h"
#include "build/fibre_regions.h"
#include "build/phantom_random.h"
#include "model/selection_text.h"

namespace radiata {
namespace {

template <typename Holds>
FibreBits bitsWhere(std::uint64_t count, Holds&& holds) {
    FibreBits bits(count);
    for (std::uint64_t f = 0; f < count; ++f) {
        if (holds(f)) bits.set(f);
    }
    return bits;
}

/// Of one point, or NaN for none.
double valueOf(const model::PointColumn& column, std::size_t fiblet, std::uint32_t point) {
    const std::uint8_t stored = column.values[64 * fiblet + point];
    if (stored == 255) return std::numeric_limits<double>::quiet_NaN();
    const glm::dvec2 range(column.ranges[fiblet]);
    return range.x + (range.y - range.x) * stored / 254.0;
}

unsigned wantedFlags(model::RegionMode mode) {
    switch (mode) {
        case model::RegionMode::kAny:
        case model::RegionMode::kAll:
            return kMeets;
        case model::RegionMode::kEitherEnd:
        case model::RegionMode::kBothEnds:
            break;
    }
    return kFirstEnd | kLastEnd;
}

bool accepts(model::RegionMode mode, std::uint8_t flags) {
    const unsigned wanted = wantedFlags(mode);
    if (mode == model::RegionMode::kAll) return (flags & (kMeets | kLeaves)) == kMeets;
    if (mode == model::RegionMode::kBothEnds) return (flags & wanted) == wanted;
    return (flags & wanted) != 0;
}

}  // namespace

FibreBits::FibreBits(std::uint64_t count, bool value) : size_(count), words_((count + 63) / 64, 0) {
    if (value) invert();
}

std::uint64_t FibreBits::count() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t word : words_) sum += static_cast<std::uint64_t>(std::popcount(word));
    return sum;
}

std::vector<std::uint32_t> FibreBits::fibres() const {
    std::vector<std::uint32_t> numbers;
    for (std::size_t w = 0; w < words_.size(); ++w) {
        for (std::uint64_t left = words_[w]; left != 0; left &= left - 1) {
            numbers.push_back(static_cast<std::uint32_t>(64 * w + static_cast<std::size_t>(std::countr_zero(left))));
        }
    }
    return numbers;
}

FibreBits& FibreBits::operator&=(const FibreBits& other) {
    for (std::size_t w = 0; w < words_.size(); ++w) words_[w] &= other.words_[w];
    return *this;
}

FibreBits& FibreBits::operator|=(const FibreBits& other) {
    for (std::size_t w = 0; w < words_.size(); ++w) words_[w] |= other.words_[w];
    return *this;
}

FibreBits& FibreBits::invert() {
    for (std::uint64_t& word : words_) word = ~word;
    if (size_ % 64 != 0) words_.back() &= (std::uint64_t{1} << (size_ % 64)) - 1;
    return *this;
}

FibreSelector::FibreSelector(std::shared_ptr<const model::FibletSet> set, MaskLookup masks, std::uint64_t cache_bytes,
                             MeshLookup meshes)
    : set_(std::move(set)), masks_(std::move(masks)), meshes_(std::move(meshes)), cache_bytes_(cache_bytes) {}

std::unique_ptr<RegionVolume> FibreSelector::region(const std::string& text) const {
    return regionVolume(model::parseRegion(text), masks_, meshes_);
}

std::shared_ptr<const model::TriangleMesh> FibreSelector::mesh(const std::string& text) const {
    region(text);  // refuses what is open
    return meshes_(model::parseRegion(text).dataset);
}

FibreBits FibreSelector::select(const model::Selection& selection) {
    using Kind = model::Selection::Kind;
    const std::uint64_t count = set_->fibres();
    switch (selection.kind) {
        case Kind::kEverything:
            return FibreBits(count, true);
        case Kind::kRegion:
            return inRegion(selection);
        case Kind::kOrdered:
            return ordered(selection);
        case Kind::kLength:
            return byLength(selection);
        case Kind::kColumn:
            return byColumn(selection);
        case Kind::kGroup:
            return inGroup(selection);
        case Kind::kFibres: {
            FibreBits bits(count);
            for (const auto& [first, last] : selection.ranges) {
                for (std::uint64_t f = first; f <= last && f < count; ++f) bits.set(f);
            }
            return bits;
        }
        case Kind::kShare:
        case Kind::kSample:
            return drawn(selection);
        case Kind::kNot:
            return select(selection.children.at(0)).invert();
        case Kind::kAnd:
        case Kind::kOr:
            break;
    }
    FibreBits bits = select(selection.children.at(0));
    for (std::size_t i = 1; i < selection.children.size(); ++i) {
        const FibreBits other = select(selection.children[i]);
        if (selection.kind == Kind::kAnd) {
            bits &= other;
        } else {
            bits |= other;
        }
    }
    return bits;
}

std::shared_ptr<const std::vector<std::uint8_t>> FibreSelector::flagsOf(const model::FibreRegion& region) {
    const std::string key = model::regionText(region);
    {
        std::lock_guard lock(mutex_);
        const auto found = kept_.find(key);
        if (found != kept_.end()) {
            found->second.used = ++clock_;
            return found->second.flags;
        }
    }
    const auto volume = regionVolume(region, masks_, meshes_);
    auto flags = std::make_shared<const std::vector<std::uint8_t>>(fibreRegionFlags(*set_, *volume));
    std::lock_guard lock(mutex_);
    kept_[key] = {flags, ++clock_};
    const std::uint64_t each = std::max<std::uint64_t>(set_->fibres(), 1);
    while (kept_.size() > 1 && kept_.size() * each > cache_bytes_) {
        kept_.erase(std::min_element(kept_.begin(), kept_.end(),
                                     [](const auto& a, const auto& b) { return a.second.used < b.second.used; }));
    }
    return flags;
}

FibreBits FibreSelector::inRegion(const model::Selection& selection) {
    const auto flags = flagsOf(selection.regions.at(0));
    return bitsWhere(flags->size(), [&](std::uint64_t f) { return accepts(selection.mode, (*flags)[f]); });
}

FibreBits FibreSelector::ordered(const model::Selection& selection) {
    FibreBits bits(set_->fibres(), true);
    std::vector<std::unique_ptr<RegionVolume>> volumes;
    for (const model::FibreRegion& region : selection.regions) {
        const auto flags = flagsOf(region);
        bits &= bitsWhere(flags->size(), [&](std::uint64_t f) { return accepts(model::RegionMode::kAny, (*flags)[f]); });
        volumes.push_back(regionVolume(region, masks_, meshes_));
    }
    // Only fibres that meet them all are decoded.
    const std::vector<std::uint32_t> candidates = bits.fibres();
    std::vector<std::uint8_t> in(candidates.size());
    parallelFor(candidates.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) in[i] = meetsInOrder(decodeFibre(*set_, candidates[i]), volumes) ? 1 : 0;
    });
    FibreBits result(set_->fibres());
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (in[i] != 0) result.set(candidates[i]);
    }
    return result;
}

FibreBits FibreSelector::byLength(const model::Selection& selection) {
    std::shared_ptr<const std::vector<float>> lengths;
    {
        std::lock_guard lock(mutex_);
        if (!lengths_) lengths_ = std::make_shared<const std::vector<float>>(fibreLengths(*set_));
        lengths = lengths_;
    }
    return bitsWhere(lengths->size(), [&](std::uint64_t f) {
        const double length = (*lengths)[f];
        return length >= selection.low && length <= selection.high;
    });
}

FibreBits FibreSelector::byColumn(const model::Selection& selection) const {
    std::string known;
    for (const model::FibreColumn& column : set_->fibre_columns) {
        known += (known.empty() ? "" : ", ") + column.name;
        if (column.name != selection.name) continue;
        return bitsWhere(set_->fibres(), [&](std::uint64_t f) {
            const double value = column.values[f * column.components];
            return value >= selection.low && value <= selection.high;
        });
    }
    for (const model::PointColumn& column : set_->point_columns) {
        known += (known.empty() ? "" : ", ") + column.name;
        if (column.name == selection.name) return byPoints(column, selection);
    }
    throw Error(Code::kNotFound, set_->source + ": there is no column '" + selection.name + "'; " +
                                     (known.empty() ? "there are none" : "there are: " + known));
}

FibreBits FibreSelector::byPoints(const model::PointColumn& column, const model::Selection& selection) const {
    return bitsWhere(set_->fibres(), [&](std::uint64_t f) {
        double sum = 0, least = std::numeric_limits<double>::infinity(), largest = -least;
        std::uint64_t count = 0;
        for (std::uint32_t i = set_->fibre_first[f]; i < set_->fibre_first[f + 1]; ++i) {
            const std::uint32_t h = set_->fibre_fiblets[i];
            const model::FibletHead& head = set_->heads[h];
            // The last point of a fiblet is the first of the next.
            const std::uint32_t points = model::fibletSegments(head) + (model::fibletIsLast(head) ? 1 : 0);
            for (std::uint32_t k = 0; k < points; ++k) {
                const double value = valueOf(column, h, k);
                if (std::isnan(value)) continue;
                sum += value;
                least = std::min(least, value);
                largest = std::max(largest, value);
                ++count;
            }
        }
        if (count == 0) return false;
        const double mean = sum / static_cast<double>(count);
        const double compared = selection.part == model::ColumnPart::kMean    ? mean
                                : selection.part == model::ColumnPart::kLeast ? least
                                                                              : largest;
        return compared >= selection.low && compared <= selection.high;
    });
}

FibreBits FibreSelector::inGroup(const model::Selection& selection) const {
    std::string known;
    for (const model::FibreGroup& group : set_->groups) {
        known += (known.empty() ? "" : ", ") + group.name;
        if (group.name != selection.name) continue;
        FibreBits bits(set_->fibres());
        for (const std::uint32_t f : group.fibres) {
            if (f < bits.size()) bits.set(f);
        }
        return bits;
    }
    throw Error(Code::kNotFound, set_->source + ": there is no group '" + selection.name + "'; " +
                                     (known.empty() ? "there are none" : "there are: " + known));
}

FibreBits FibreSelector::drawn(const model::Selection& selection) const {
    const std::uint64_t count = set_->fibres();
    if (selection.kind == model::Selection::Kind::kShare) {
        if (selection.amount >= 1) return FibreBits(count, true);
        const double limit = std::ldexp(selection.amount, 64);
        return bitsWhere(count, [&](std::uint64_t f) { return static_cast<double>(phantom::hash(selection.seed, f)) < limit; });
    }
    const auto wanted = static_cast<std::uint64_t>(selection.amount);
    if (wanted >= count) return FibreBits(count, true);
    FibreBits bits(count);
    if (wanted == 0) return bits;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> draws(count);
    for (std::uint64_t f = 0; f < count; ++f) draws[f] = {phantom::hash(selection.seed, f), static_cast<std::uint32_t>(f)};
    std::nth_element(draws.begin(), draws.begin() + static_cast<std::ptrdiff_t>(wanted - 1), draws.end());
    for (std::uint64_t i = 0; i < wanted; ++i) bits.set(draws[i].second);
    return bits;
}

}  // namespace radiata
