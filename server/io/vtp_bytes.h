// The bytes of one array of a .vtp file: base64 is decoded, zlib blocks are expanded one at a time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "io/byte_source.h"
#include "io/vtp_document.h"

namespace radiata::io {

/// From front to back. Takes memory for the sizes of the blocks and for one block, both held against what the file can hold.
class VtpBytes {
public:
    /// \param array  not text; lies in the document, which outlives this
    /// \throws Error(kCorrupt) for sizes or an offset that the file has no room for
    VtpBytes(const VtpDocument& document, const VtpArray& array);

    /// As the sizes before the array say.
    std::uint64_t size() const { return size_; }
    /// All of `out`. \throws Error(kCorrupt) if the array or the file ends before, for bad base64 and for bad zlib blocks
    void read(std::span<std::byte> out);

private:
    [[noreturn]] void fail(const std::string& what) const;
    std::uint64_t word();
    /// The next bytes as they are without base64.
    void stored(std::span<std::byte> out);
    int nextCharacter();
    void nextFour();
    /// At most this many stored bytes are left.
    std::uint64_t room() const;
    void readSizes();
    void nextBlock();

    const VtpDocument* document_;
    const VtpArray* array_;
    bool base64_;
    std::optional<ByteSource> file_;
    std::string_view text_;  ///< of base64, not yet taken
    std::vector<char> ahead_;
    std::array<std::byte, 3> three_{};
    std::size_t three_next_ = 0, three_count_ = 0;
    std::uint64_t size_ = 0, left_ = 0;
    std::uint64_t block_bytes_ = 0, last_bytes_ = 0;
    std::vector<std::uint64_t> packed_sizes_;
    std::size_t block_ = 0, in_block_ = 0;
    std::vector<std::byte> packed_, expanded_;
};

}  // namespace radiata::io
