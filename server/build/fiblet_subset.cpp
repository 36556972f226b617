#include "build/fiblet_subset.h"

#include <algorithm>
#include <utility>

#include "build/fiblet_pages.h"
#include "build/phantom_random.h"

namespace radiata {
namespace {

constexpr std::uint64_t kSeed = 0x66696272;
constexpr std::uint64_t kRecordBytes = sizeof(model::FibletHead) + sizeof(shader::FibletBox);
constexpr std::uint32_t kPlaceMask = 1023U << 10;  ///< of FibletHead::shape: where the codes begin

/// One flag per fibre.
std::vector<bool> chosenFibres(const model::FibletSet& set, std::uint64_t bytes_max, std::uint64_t& count) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order(set.fibres());
    for (std::uint32_t f = 0; f < order.size(); ++f) order[f] = {phantom::hash(kSeed, f), f};
    std::ranges::sort(order);
    std::vector<bool> chosen(set.fibres());
    std::uint64_t bytes = 0;
    for (const auto& [key, fibre] : order) {
        for (std::uint32_t i = set.fibre_first[fibre]; i < set.fibre_first[fibre + 1]; ++i) {
            bytes += kRecordBytes + std::uint64_t{4} * wordsOf(set.heads[set.fibre_fiblets[i]]);
        }
        if (bytes > bytes_max) break;
        chosen[fibre] = true;
        ++count;
    }
    return chosen;
}

}  // namespace

FibletSubset fibletSubset(const model::FibletSet& set, std::uint64_t bytes_max) {
    FibletSubset subset;
    const std::vector<bool> chosen = chosenFibres(set, bytes_max, subset.fibres);
    subset.places.resize(set.pages.size());
    for (std::uint32_t p = 0; p < set.pages.size(); ++p) {
        shader::FibletPlace& place = subset.places[p];
        place.first_head = static_cast<std::uint32_t>(subset.heads.size());
        place.first_word = static_cast<std::uint32_t>(subset.codes.size());
        for (std::uint32_t lane = 0; lane < set.pages[p].count; ++lane) {
            const std::uint32_t fiblet = p * shader::FIBLET_PAGE + lane;
            model::FibletHead head = set.heads[fiblet];
            if (!chosen[head.fibre]) continue;
            (lane < 32 ? place.held_low : place.held_high) |= 1U << (lane % 32);
            const auto from = set.codes.begin() + set.pages[p].first_word + model::fibletWord(head);
            const auto word = static_cast<std::uint32_t>(subset.codes.size()) - place.first_word;
            subset.codes.insert(subset.codes.end(), from, from + wordsOf(head));
            head.shape = (head.shape & ~kPlaceMask) | word / 2 << 10;
            subset.heads.push_back(head);
            subset.boxes.push_back(set.boxes[fiblet]);
        }
    }
    return subset;
}

}  // namespace radiata
