// Loops over all cores.
#pragma once

#include <cstddef>
#include <functional>

namespace radiata {

/// Calls body(begin, end) for disjoint blocks that cover [0, count), on all hardware threads; returns when all are done.
/// \param block  indices per call; small enough that the threads end together
/// \throws whatever a body threw first
void parallelFor(std::size_t count, std::size_t block, const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace radiata
