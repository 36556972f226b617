// Files that are there whole or not at all.
#pragma once

#include <string>
#include <string_view>

namespace radiata::client {

/// Writes beside the file and renames, so that nobody ever reads half a picture. "-" is standard output.
/// \throws ClientError(kOutput)
void writeFile(const std::string& file, std::string_view bytes);

/// Tells before anything is rendered whether writeFile would work: the folder must exist and let files be made.
/// \throws ClientError(kOutput)
void checkWritable(const std::string& file);

}  // namespace radiata::client
