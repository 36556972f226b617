// The arrays of a .trx file, which is a zip file or a folder: their names, sizes and bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>

namespace radiata::io {

/// One array from front to back.
class TrxStream {
public:
    virtual ~TrxStream() = default;
    /// Fills `out`. \throws Error(kCorrupt) if less is there or the compressed bytes are damaged
    virtual void read(std::span<std::byte> out) = 0;
};

class TrxFiles {
public:
    struct Entry {
        std::uint64_t bytes = 0;   ///< as read
        std::uint64_t stored = 0;  ///< in the file
        std::uint64_t place = 0;   ///< in the zip file's directory
    };

    /// Looks at the directory only. In a folder only regular files count, and links are not followed: a folder from elsewhere
    /// must not be able to make the server read other files.
    /// \throws Error(kNotFound, kCorrupt, kUnavailable)
    explicit TrxFiles(const std::filesystem::path& path);

    /// Relative path -> entry, sorted.
    const std::map<std::string, Entry>& entries() const { return entries_; }
    /// Each stream has a file handle of its own, so that several can be read side by side.
    std::unique_ptr<TrxStream> open(const std::string& entry) const;
    /// All of a small entry. \throws Error(kResourceExhausted) if it has more than `bytes_max`
    std::string readAll(const std::string& entry, std::uint64_t bytes_max) const;
    /// File or folder name, for messages.
    std::string name() const { return path_.filename().string(); }
    std::uint64_t storedBytes() const;

private:
    std::filesystem::path path_;
    bool folder_ = false;
    std::map<std::string, Entry> entries_;
};

}  // namespace radiata::io
