// The bytes of a file of data from front to back, plain or gzip-compressed, never more of them than the caller has room for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>

#include <zlib.h>

namespace radiata::io {

/// How a file's bytes are packed.
enum class Packing {
    kByName,  ///< gzip if the name ends in .gz, else not
    kPlain,
    kGzip,
};

/// Not thread-safe; one object per reader.
class ByteSource {
public:
    /// Opens a file; one whose name ends in .gz is decompressed. Only regular files: a pipe could block for ever.
    /// \throws Error(kNotFound) if there is no such regular file, (kCorrupt) if it is empty or a .gz file is not gzip,
    ///         (kUnavailable) if it cannot be opened
    explicit ByteSource(const std::filesystem::path& path) : ByteSource(path, Packing::kByName, 0) {}
    /// \param begin  bytes of the file itself before the content, which is byte 0 for all that follows
    ByteSource(const std::filesystem::path& path, Packing packing, std::uint64_t begin);

    /// Reads up to out.size() bytes; fewer only at the end of the file.
    /// \throws Error(kCorrupt) naming the offset if the compressed stream is damaged, (kUnavailable) if reading fails
    std::size_t read(std::span<std::byte> out);

    /// Moves forward to a byte offset of the (decompressed) content. \throws as read(), and if the file ends before
    void skipTo(std::uint64_t offset);

    /// Makes sure that content [0, end) can be there at all, before anyone takes memory for it: the size of a plain file is
    /// known, and deflate never shrinks by more than 1032 to 1, so a small .gz file cannot stand for gigabytes.
    /// \throws Error(kCorrupt) with both sizes
    void requireContent(std::uint64_t end) const;

    /// To be called after the last read: lets zlib compare the checksum if that was the end of a gzip stream.
    /// Bytes that follow the image are allowed, as in every other reader, and are not looked at.
    void finish();

    bool compressed() const { return compressed_ != nullptr; }
    /// Of the file from the content's begin on.
    std::uint64_t fileBytes() const { return file_bytes_; }
    /// Bytes of the file that were taken so far, compressed ones of a .gz file.
    std::uint64_t fileBytesRead() const;
    /// Offset of the next byte in the (decompressed) content.
    std::uint64_t position() const { return position_; }
    const std::filesystem::path& path() const { return path_; }
    /// For messages: the file's name without folders, because messages may travel to clients.
    std::string name() const { return path_.filename().string(); }

private:
    struct CloseFile {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    struct CloseGzip {
        void operator()(gzFile_s* file) const { gzclose_r(file); }
    };

    std::filesystem::path path_;
    std::uint64_t file_bytes_ = 0;
    std::uint64_t position_ = 0;
    std::unique_ptr<std::FILE, CloseFile> plain_;
    std::unique_ptr<gzFile_s, CloseGzip> compressed_;
};

}  // namespace radiata::io
