#include "ingest/scratch_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace radiata::ingest {

ScratchFile::ScratchFile(std::filesystem::path path) : path_(std::move(path)) {
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file_ < 0) fail("cannot be created");
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) return;
    const int reason = errno;
    ::close(file_);
    if (reason == EWOULDBLOCK) {
        throw Error(Code::kUnavailable, path_.string() + ": another program is working with this file; wait for it to end");
    }
    errno = reason;
    fail("cannot be locked");
}

ScratchFile::~ScratchFile() { ::close(file_); }

std::uint64_t ScratchFile::bytes() const {
    struct stat about {};
    if (::fstat(file_, &about) != 0) fail("cannot be read");
    return static_cast<std::uint64_t>(about.st_size);
}

std::size_t ScratchFile::read(std::uint64_t at, std::span<std::byte> out) const {
    std::size_t done = 0;
    while (done < out.size()) {
        const ssize_t got = ::pread(file_, out.data() + done, out.size() - done, static_cast<off_t>(at + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail("cannot be read");
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

void ScratchFile::write(std::uint64_t at, std::span<const std::byte> bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t put = ::pwrite(file_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(at + done));
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) fail("cannot be written");
        done += static_cast<std::size_t>(put);
    }
}

void ScratchFile::cut(std::uint64_t bytes) {
    if (::ftruncate(file_, static_cast<off_t>(bytes)) != 0) fail("cannot be cut");
}

void ScratchFile::remove() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

void ScratchFile::fail(const char* what) const {
    throw Error(Code::kUnavailable, path_.string() + ": " + what + " (" + std::strerror(errno) + ")");
}

}  // namespace radiata::ingest
