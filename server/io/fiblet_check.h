// Whether the parts of a set of fiblets fit together, so that whoever decodes it need not look.
#pragma once

#include <string>

#include "model/fiblet_set.h"

namespace radiata::io {

/// Checks counts, pages, heads, and the index from fibres to fiblets.
/// \param words  of codes, without the one behind them
/// \param name   for messages
/// \throws Error(kCorrupt) naming the page, fiblet or fibre and what contradicts what
void checkFiblets(const model::FibletSet& set, std::uint64_t words, const std::string& name);

}  // namespace radiata::io
