// Lines of legacy VTK files (.vtk), text or binary, read batch by batch.
// Format: VTK User's Guide, "VTK File Formats", "Legacy"; LINES as counts and ids together (to version 4.2), or as OFFSETS and
// CONNECTIVITY (from 5.1).
#pragma once

#include <filesystem>
#include <memory>

#include "model/tractogram.h"

namespace radiata::io {

/// Which way the first two axes of the file point; such files do not say so themselves.
enum class VtkSpace {
    kAuto,  ///< as the title line says ("SPACE=LPS", as 3D Slicer writes), else RAS, with a remark
    kRas,
    kLps,
};

/// Arrays of POINT_DATA become vertex columns, of CELL_DATA fibre columns where all cells are lines. Points are streamed as
/// long as lines take them one after another, as every tractography program writes them; else they are held in memory. \throws
/// Error(kCorrupt) naming keyword, offset and value; (kUnsupported) for other datasets than POLYDATA
std::unique_ptr<model::TractogramSource> openVtkLines(const std::filesystem::path& path, VtkSpace space);

}  // namespace radiata::io
