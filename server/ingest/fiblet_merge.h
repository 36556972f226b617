// Runs of fiblets into one file in the order of all.
#pragma once

#include <cstdint>
#include <filesystem>

#include "build/fiblet_measure.h"
#include "ingest/fiblet_runs.h"
#include "model/fiblet_set.h"

namespace radiata::ingest {

/// Writes the .fiblet file that one run of all would give, byte for byte.
/// \param set           codec, origin, errors, points, names of columns, groups
/// \param memory_bytes  to be used, about; each run takes 8 KiB at least
/// \throws Error(kUnavailable) naming the reason, such as a full disk; the target is not there then
void mergeRuns(FibletRuns& runs, const model::FibletSet& set, std::uint64_t memory_bytes, const std::filesystem::path& out,
               const FibletProgress& progress);

}  // namespace radiata::ingest
