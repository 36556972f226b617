// A file that is written at its end and read anywhere, and outlives its program if that is ended by force.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace radiata::ingest {

class ScratchFile {
public:
    /// Opens or makes it; it stays on the disk until remove(). One program at a time.
    /// \throws Error(kUnavailable) if that cannot be, or another program has it
    explicit ScratchFile(std::filesystem::path path);
    ~ScratchFile();
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    std::uint64_t bytes() const;
    /// \return how many bytes there were; fewer only at the end
    std::size_t read(std::uint64_t at, std::span<std::byte> out) const;
    /// \throws Error(kUnavailable) naming the reason, such as a full disk
    void write(std::uint64_t at, std::span<const std::byte> bytes);
    void cut(std::uint64_t bytes);
    void remove();
    const std::filesystem::path& path() const { return path_; }

private:
    [[noreturn]] void fail(const char* what) const;

    std::filesystem::path path_;
    int file_ = -1;
};

}  // namespace radiata::ingest
