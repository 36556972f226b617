// Tractogram files of all formats, by their names' endings.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "io/vtk_lines.h"
#include "model/tractogram.h"

namespace radiata::io {

struct TractOptions {
    VtkSpace vtk_space = VtkSpace::kAuto;
    std::vector<std::filesystem::path> columns;  ///< .tsf and text files (io/track_columns.h)
};

/// Whether a name ends as a readable tractogram's does: .tck, .tck.gz, .trk, .trk.gz, .trx, .tt, .tt.gz, .vtk, .vtp.
bool isTractogramName(const std::filesystem::path& path);

/// Opens a file (or .trx folder) for reading from front to back; the header is read and checked.
/// \throws Error(kUnsupported) for another ending, and as the format's reader (io/tck.h, trk.h, trx.h, tt.h, vtk_lines.h,
/// vtp_lines.h)
std::unique_ptr<model::TractogramSource> openTractogram(const std::filesystem::path& path, const TractOptions& options = {});

/// Writes .tck or .trx. \return the files written. \throws Error(kUnsupported) for another ending, before anything is read, and
/// as writeTck() and writeTrx()
std::vector<std::filesystem::path> writeTractogram(model::TractogramSource& source, const std::filesystem::path& path);
/// The check alone, to be done before long work.
void requireWritableName(const std::filesystem::path& path);

}  // namespace radiata::io
