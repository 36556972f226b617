// Tractograms of any size to .fiblet files, in bounded memory, restartable.
//
// Runs of fibres are encoded into a scratch file beside the target, NAME.fiblet.runs, and then merged. The scratch file stays
// if the conversion is ended by force or for want of room; the next one of the same input with the same settings goes on
// after its last complete run, and the file is the same, byte for byte.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "build/fiblet_encode.h"
#include "model/fiblet_set.h"

namespace radiata::ingest {

struct ConversionOptions {
    FibletOptions fiblets;
    /// About what the conversion takes, apart from groups (4 bytes for each fibre in each), one fibre at a time, and what the
    /// reader of the format needs.
    std::uint64_t memory_bytes = std::uint64_t{512} << 20;
    bool keep_unfinished = true;  ///< complete runs after an error, for the next attempt; else they are removed
};

struct Conversion {
    model::FibletSet set;  ///< what the header says of codec, errors and points, and the names of the columns
    std::uint64_t fibres = 0;
    std::uint64_t continued = 0;  ///< fibres that an earlier conversion had encoded
};

/// Names, sizes, times of change and the first megabyte of each file, as text that differs when they do.
std::string stateOf(const std::vector<std::filesystem::path>& files);

/// \param open   gives the tractogram from its beginning
/// \param state  of the input (stateOf), to know it again
/// \param log    told what is continued; may be empty
/// \throws as encodeFiblets(), and Error(kUnavailable) naming the reason, such as a full disk, and what was kept
Conversion convertToFiblets(const OpenTractogram& open, const std::string& state, const std::filesystem::path& out,
                            const ConversionOptions& options, const FibletProgress& progress = {},
                            const std::function<void(const std::string&)>& log = {});

}  // namespace radiata::ingest
