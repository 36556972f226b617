// Headers that name another file for their samples: only files in the header's own folder are opened.
#pragma once

#include <filesystem>
#include <string>

namespace radiata::io {

/// \param header_path  of the file that names it; \param name  relative, without '..'
/// \return where it is, links resolved
/// \throws Error(kInvalidArgument) if it is not inside the header's folder, (kNotFound) if there is no such regular file
std::filesystem::path dataFileBeside(const std::filesystem::path& header_path, const std::string& name);

}  // namespace radiata::io
