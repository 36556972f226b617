// Puts encoded fiblets into Morton order and makes what goes with it: pages with boxes, the index from fibres to fiblets, and
// boxes of the fiblets.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "model/fiblet_set.h"

namespace radiata {

/// A fiblet before it has a place: its codes are words [first_word, first_word + words) of a heap.
struct LooseFiblet {
    model::FibletHead head{};
    std::uint64_t first_word = 0;
};

/// A fiblet's place in the order of a file, and its number in the list it came from.
struct OrderedFiblet {
    std::uint64_t morton = 0;  ///< of the cell that its middle point lies in
    std::uint32_t number = 0;
    auto operator<=>(const OrderedFiblet&) const = default;
};

/// Fiblets in the order of a file; ties are broken by place in the list.
std::vector<OrderedFiblet> orderFiblets(const std::vector<LooseFiblet>& fiblets, const std::vector<std::uint32_t>& heap,
                                        const shader::FibletCodec& codec);

/// Words of codes of a head.
inline std::uint32_t wordsOf(const model::FibletHead& head) {
    return model::fibletWords(model::fibletSegments(head), model::fibletWidth(head), model::fibletIsShortened(head));
}

/// Appends a fiblet to the last page of a set, or to a new one.
void appendFiblet(model::FibletSet& set, model::FibletHead head, const std::uint32_t* words);

/// Fills heads, codes, pages, boxes, fibre_first and fibre_fiblets of a set whose codec and origin are known.
/// Ties in the order are broken by place in the list, so equal input gives equal bytes.
/// \param fibres  how many, those without fiblets included
/// \return the order: head i is that of fiblet number order[i] of the list
std::vector<std::uint32_t> arrangeFiblets(model::FibletSet& set, const std::vector<LooseFiblet>& fiblets,
                                          const std::vector<std::uint32_t>& heap, std::uint64_t fibres);

/// \throws Error(kResourceExhausted) if so many cannot be numbered with 32 bits
void requireFibletRoom(std::uint64_t fiblets, std::uint64_t words, const std::string& source);

/// Boxes of pages and of fiblets from the decoded points. Used by arrangeFiblets and after reading a file.
void boundFiblets(model::FibletSet& set);

/// fibre_first and fibre_fiblets from the heads.
void indexFibres(model::FibletSet& set, std::uint64_t fibres);

}  // namespace radiata
