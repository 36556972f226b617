#include "io/byte_source.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "base/checked.h"
#include "base/error.h"

namespace radiata::io {
namespace {

constexpr unsigned kGzipBufferBytes = 1U << 18;
constexpr std::size_t kReadMax = std::size_t{1} << 30;  // zlib counts one read in an int
constexpr std::uint64_t kDeflateRatioMax = 1032;        // zlib's technical notes: the limit of the format

}  // namespace

ByteSource::ByteSource(const std::filesystem::path& path, Packing packing, std::uint64_t begin) : path_(path) {
    std::error_code failure;
    if (!std::filesystem::is_regular_file(path, failure)) {
        throw Error(Code::kNotFound, name() + ": there is no regular file of this name; data are read from files only");
    }
    file_bytes_ = std::filesystem::file_size(path, failure);
    if (failure) throw Error(Code::kUnavailable, name() + ": its size cannot be read (" + failure.message() + ")");
    if (file_bytes_ == 0) throw Error(Code::kCorrupt, name() + ": the file is empty (0 bytes); data have a header");

    if (begin >= file_bytes_) {
        throw Error(Code::kCorrupt, name() + ": the data should begin at byte " + std::to_string(begin) + ", the file has " +
                                        std::to_string(file_bytes_) + " bytes");
    }
    file_bytes_ -= begin;
    plain_.reset(std::fopen(path.c_str(), "rbe"));
    if (!plain_ || fseeko(plain_.get(), static_cast<off_t>(begin), SEEK_SET) != 0) {
        throw Error(Code::kUnavailable, name() + ": cannot be opened (" + std::strerror(errno) + ")");
    }
    if (packing == Packing::kPlain || (packing == Packing::kByName && path.extension() != ".gz")) return;
    // zlib takes a descriptor of its own, which stands where the file does.
    const int descriptor = dup(fileno(plain_.get()));
    if (descriptor >= 0 && lseek(descriptor, static_cast<off_t>(begin), SEEK_SET) >= 0) {
        compressed_.reset(gzdopen(descriptor, "rb"));
    }
    if (!compressed_) {
        if (descriptor >= 0) close(descriptor);
        throw Error(Code::kUnavailable, name() + ": cannot be opened (" + std::strerror(errno) + ")");
    }
    gzbuffer(compressed_.get(), kGzipBufferBytes);
    if (gzdirect(compressed_.get()) != 0) {
        const std::string why = packing == Packing::kByName ? "the name ends in .gz" : "the header says gzip";
        throw Error(Code::kCorrupt, name() + ": " + why + " but the content is not gzip (it must begin with 1f 8b)");
    }
}

std::size_t ByteSource::read(std::span<std::byte> out) {
    std::size_t done = 0;
    while (done < out.size()) {
        const std::size_t wanted = std::min(out.size() - done, kReadMax);
        std::size_t got = 0;
        if (compressed_) {
            const int count = gzread(compressed_.get(), out.data() + done, static_cast<unsigned>(wanted));
            int status = Z_OK;
            const char* reason = gzerror(compressed_.get(), &status);
            if (count < 0 || (status != Z_OK && status != Z_STREAM_END)) {
                // zlib puts the whole path before its reason; folders are nothing for a message.
                const std::string_view text(reason);
                const std::size_t colon = text.rfind(": ");
                throw Error(Code::kCorrupt, name() + ": the gzip stream is damaged or cut off (" +
                                                std::string(text.substr(colon == text.npos ? 0 : colon + 2)) + ")");
            }
            got = static_cast<std::size_t>(count);
        } else {
            got = std::fread(out.data() + done, 1, wanted, plain_.get());
            if (got < wanted && std::ferror(plain_.get())) {
                throw Error(Code::kUnavailable, name() + ": reading failed at byte " + std::to_string(position_));
            }
        }
        if (got == 0) break;
        done += got;
        position_ += got;
    }
    return done;
}

void ByteSource::skipTo(std::uint64_t offset) {
    std::vector<std::byte> scratch(std::min<std::uint64_t>(offset - std::min(offset, position_), 1U << 16));
    while (position_ < offset) {
        const auto step = static_cast<std::size_t>(std::min<std::uint64_t>(scratch.size(), offset - position_));
        if (read(std::span(scratch).first(step)) < step) {
            throw Error(Code::kCorrupt, name() + ": the file ends after " + std::to_string(position_) +
                                            " bytes, before its data should begin at byte " + std::to_string(offset));
        }
    }
}

void ByteSource::requireContent(std::uint64_t end) const {
    if (!compressed()) {
        if (end > file_bytes_) {
            throw Error(Code::kCorrupt, name() + ": the header promises data up to byte " + std::to_string(end) +
                                            ", the file has " + std::to_string(file_bytes_) + " bytes");
        }
        return;
    }
    const std::uint64_t most = checkedMultiply(file_bytes_, kDeflateRatioMax, name());
    if (end > most) {
        throw Error(Code::kCorrupt, name() + ": the header promises " + std::to_string(end) + " bytes, " +
                                        std::to_string(file_bytes_) + " compressed bytes can hold at most " +
                                        std::to_string(most));
    }
}

std::uint64_t ByteSource::fileBytesRead() const {
    if (!compressed_) return position_;
    const z_off_t offset = gzoffset(compressed_.get());
    return offset < 0 ? 0 : static_cast<std::uint64_t>(offset);
}

void ByteSource::finish() {
    std::byte next{};
    if (compressed_) read(std::span(&next, 1));
}

}  // namespace radiata::io
