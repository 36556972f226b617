#include "common/output_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <unistd.h>

#include "common/client_error.h"

namespace radiata::client {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
    throw ClientError(ExitCode::kOutput, file + " cannot be written: " + why);
}

bool writeAll(std::FILE* stream, std::string_view bytes) {
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size();
    return std::fflush(stream) == 0 && written;
}

}  // namespace

void writeFile(const std::string& file, std::string_view bytes) {
    if (file == "-") {
        if (!writeAll(stdout, bytes)) refuse("standard output", std::strerror(errno));
        return;
    }
    // A device or pipe is written in place; renaming would replace it.
    std::error_code ignored;
    const bool in_place = std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored);
    const std::string part = in_place ? file : file + ".part" + std::to_string(::getpid());
    std::FILE* stream = std::fopen(part.c_str(), "wb");
    if (stream == nullptr) refuse(file, std::strerror(errno));
    const bool written = writeAll(stream, bytes);
    const int write_error = errno;
    const bool closed = std::fclose(stream) == 0;
    if (written && closed && (in_place || std::rename(part.c_str(), file.c_str()) == 0)) return;
    const int error = written ? errno : write_error;
    if (!in_place) std::remove(part.c_str());
    refuse(file, std::strerror(error));
}

void checkWritable(const std::string& file) {
    if (file == "-") return;
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) refuse(file, "it is a folder");
    std::filesystem::path folder = std::filesystem::path(file).parent_path();
    if (folder.empty()) folder = ".";
    if (!std::filesystem::is_directory(folder, error)) refuse(file, "the folder " + folder.string() + " does not exist");
    const bool exists = std::filesystem::exists(file, error);
    if (::access(exists ? file.c_str() : folder.c_str(), W_OK) != 0) refuse(file, std::strerror(errno));
}

}  // namespace radiata::client
