// Files that are written from front to back and removed if they cannot be finished.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace radiata::io {

/// Writes beside the target and takes its name only when all is there, so nobody meets half a file.
class WriteFile {
public:
    /// \throws Error(kUnavailable) if it cannot be created
    explicit WriteFile(const std::filesystem::path& path);
    ~WriteFile();
    WriteFile(const WriteFile&) = delete;
    WriteFile& operator=(const WriteFile&) = delete;

    /// \throws Error(kUnavailable) naming the reason, such as a full disk
    void write(std::span<const std::byte> bytes);
    void write(const std::string& text) { write(std::as_bytes(std::span(text))); }
    template <typename T>
    void writeNumbers(std::span<const T> numbers) {
        write(std::as_bytes(numbers));
    }
    /// Goes back to an offset, for a header that is known only at the end.
    void seek(std::uint64_t offset);
    /// The last call: gives the file its name. \throws Error(kUnavailable)
    void finish();
    const std::filesystem::path& path() const { return path_; }

private:
    [[noreturn]] void fail(const char* what);

    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::filesystem::path path_, part_;
    std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace radiata::io
