// NRRD headers (.nrrd with the data behind it, .nhdr with the data in a file of its own), as far as scalar volumes go.
// Source: the definition of the format, teem.sourceforge.net/nrrd/format.html. The one library for it in Debian 12, libteem, is
// a snapshot of 2016 that takes memory for what a header claims and opens whatever file it names; so the text is parsed here,
// and zlib does the rest. teem itself writes files that the tests read.
#pragma once

#include <filesystem>

#include "io/stored_image.h"

namespace radiata::io {

/// Types: all integers and floats of 8 to 64 bits. Encodings: raw and gzip. Three axes are of space; others must have length 1.
/// Spaces right-anterior-superior, left-anterior-superior and left-posterior-superior become RAS, others are taken as they are;
/// without a space the axes run along the world's, with the spacings, from the origin on. \throws Error(kCorrupt) for a header
/// that contradicts itself, (kUnsupported) for other encodings, types, lists of data files and
///         several volumes, (kInvalidArgument, kNotFound) for a data file outside the folder or that is not there
StoredImage readNrrdHeader(const std::filesystem::path& path);

}  // namespace radiata::io
