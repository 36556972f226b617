// Puts encoded fiblets into Morton order and makes what goes with it: pages with boxes, the index from fibres to fiblets, and
// boxes of the fiblets.
#pragma once

#include <cstdint>
#include <vector>

#include "model/fiblet_set.h"

namespace radiata {

/// A fiblet before it has a place: its codes are words [first_word, first_word + words) of a heap.
struct LooseFiblet {
    model::FibletHead head{};
    std::uint64_t first_word = 0;
};

/// Fills heads, codes, pages, boxes, fibre_first and fibre_fiblets of a set whose codec and origin are known.
/// Ties in the order are broken by place in the list, so equal input gives equal bytes.
/// \param fibres  how many, those without fiblets included
/// \return the order: head i is that of fiblet number order[i] of the list
std::vector<std::uint32_t> arrangeFiblets(model::FibletSet& set, const std::vector<LooseFiblet>& fiblets,
                                          const std::vector<std::uint32_t>& heap, std::uint64_t fibres);

/// Boxes of pages and of fiblets from the decoded points. Used by arrangeFiblets and after reading a file.
void boundFiblets(model::FibletSet& set);

/// fibre_first and fibre_fiblets from the heads.
void indexFibres(model::FibletSet& set, std::uint64_t fibres);

}  // namespace radiata
