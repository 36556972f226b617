#include "io/write_file.h"

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace radiata::io {

WriteFile::WriteFile(const std::filesystem::path& path) : path_(path), part_(path) {
    part_ += ".part";
    file_.reset(std::fopen(part_.c_str(), "wbe"));
    if (!file_) fail("cannot be created");
}

WriteFile::~WriteFile() {
    if (!file_) return;
    file_.reset();
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
}

void WriteFile::write(std::span<const std::byte> bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) < bytes.size()) fail("cannot be written");
}

void WriteFile::seek(std::uint64_t offset) {
    if (std::fseek(file_.get(), static_cast<long>(offset), SEEK_SET) != 0) fail("cannot be written");
}

void WriteFile::finish() {
    if (std::fflush(file_.get()) != 0) fail("cannot be written");
    if (std::fclose(file_.release()) != 0) {
        std::error_code ignored;
        std::filesystem::remove(part_, ignored);
        fail("cannot be written");
    }
    std::error_code failure;
    std::filesystem::rename(part_, path_, failure);
    if (!failure) return;
    errno = failure.value();
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
    fail("cannot be given its name");
}

void WriteFile::fail(const char* what) {
    throw Error(Code::kUnavailable, path_.string() + ": " + what + " (" + std::strerror(errno) + ")");
}

}  // namespace radiata::io
