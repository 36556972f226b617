// Tractograms as files of fiblets, docs/formats/fiblet.md.
#pragma once

#include <filesystem>

#include "model/fiblet_set.h"

namespace radiata::io {

/// Whether a name ends in .fiblet.
bool isFibletName(const std::filesystem::path& path);

/// Reads and checks everything; `boxes` stay empty (build/fiblet_pages.h makes them).
/// \throws Error(kNotFound, kUnavailable) if it cannot be opened, Error(kCorrupt) naming what contradicts what, with values, if
/// it is not
///         whole and sound, Error(kUnsupported) for a version this program does not know
model::FibletSet readFiblets(const std::filesystem::path& path);

/// What can be told without reading more than the header: counts, codec, errors and origin; no heads, codes or columns.
model::FibletSet readFibletHeader(const std::filesystem::path& path);

/// The file appears under its name when it is complete. Equal sets give equal bytes.
/// \throws Error(kUnavailable) naming the reason, such as a full disk
void writeFiblets(const model::FibletSet& set, const std::filesystem::path& path);

}  // namespace radiata::io
