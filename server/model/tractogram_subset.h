// Some fibres of a tractogram as a tractogram of their own, for export.
#pragma once

#include <memory>
#include <vector>

#include "model/tractogram.h"

namespace radiata::model {

/// The fibres of these numbers, numbered anew from 0 in the same order; groups keep those of their fibres that are among them,
/// and groups without any are left out. \param fibres  ascending
std::unique_ptr<TractogramSource> subsetOf(std::unique_ptr<TractogramSource> source, std::vector<std::uint32_t> fibres);

}  // namespace radiata::model
