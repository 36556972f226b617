// Lines of VTK XML files (.vtp, PolyData), read batch by batch.
// Format: VTK User's Guide, "VTK File Formats", "XML File Formats".
#pragma once

#include <filesystem>
#include <memory>

#include "io/vtk_lines.h"
#include "model/tractogram.h"

namespace radiata::io {

/// Text, base64 and appended arrays (base64 or raw), plain or in zlib blocks; pieces follow each other. Arrays of PointData
/// become vertex columns, of CellData fibre columns; all pieces with lines need those of the first. The axes are those of a
/// comment "SPACE=LPS" or of a field SPACE, else as VtkSpace::kAuto says. Points are streamed as long as lines take them one
/// after another; else those of one piece are held in memory. \throws Error as io/vtp_document.h, vtp_numbers.h; (kCorrupt)
/// naming the line for offsets that descend and ids that point past the end
std::unique_ptr<model::TractogramSource> openVtpLines(const std::filesystem::path& path, VtkSpace space);

}  // namespace radiata::io
