#include "io/vtp_bytes.h"

#include <algorithm>
#include <cstring>

#include <zlib.h>

#include "base/checked.h"
#include "base/error.h"
#include "io/text.h"

namespace radiata::io {
namespace {

constexpr std::uint64_t kDeflateRatioMax = 1032;  // zlib's technical notes: the limit of the format
constexpr std::size_t kAhead = std::size_t{1} << 16;

/// RFC 4648, section 4; -1 for other characters.
int base64Value(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

}  // namespace

VtpBytes::VtpBytes(const VtpDocument& document, const VtpArray& array)
    : document_(&document),
      array_(&array),
      base64_(array.place == VtpArray::Place::kBase64 || document.appended_base64),
      text_(array.text) {
    if (array.place == VtpArray::Place::kAppended) {
        const std::uint64_t begin = checkedAdd(document.appended, array.offset, document.name());
        std::error_code failure;
        const std::uint64_t bytes = std::filesystem::file_size(document.path, failure);
        if (failure || begin >= bytes) {
            fail("has the offset " + std::to_string(array.offset) + "; there are " +
                 std::to_string(bytes - std::min(bytes, document.appended)) + " appended bytes");
        }
        file_.emplace(document.path, Packing::kPlain, begin);
    }
    if (document.zlib) {
        readSizes();
    } else {
        size_ = word();
        if (size_ > room()) {
            fail("claims " + std::to_string(size_) + " bytes; the file has room for " + std::to_string(room()));
        }
    }
    left_ = size_;
}

void VtpBytes::fail(const std::string& what) const {
    throw Error(Code::kCorrupt, document_->name() + ": the array " + shown(array_->name) + " " + what);
}

std::uint64_t VtpBytes::word() {
    std::array<std::byte, 8> bytes{};
    const std::span<std::byte> own = std::span(bytes).first(document_->word_bytes);
    stored(own);
    if (document_->swapped) std::reverse(own.begin(), own.end());
    if (own.size() == 8) {
        std::uint64_t value = 0;
        std::memcpy(&value, own.data(), sizeof(value));
        return value;
    }
    std::uint32_t value = 0;
    std::memcpy(&value, own.data(), sizeof(value));
    return value;
}

std::uint64_t VtpBytes::room() const {
    const std::uint64_t in_file = file_ ? file_->fileBytes() - file_->position() : 0;
    if (!base64_) return in_file;
    return (in_file + text_.size()) / 4 * 3 + 3;
}

int VtpBytes::nextCharacter() {
    if (text_.empty() && file_) {
        ahead_.resize(kAhead);
        ahead_.resize(file_->read(std::as_writable_bytes(std::span(ahead_))));
        text_ = std::string_view(ahead_.data(), ahead_.size());
    }
    if (text_.empty()) return -1;
    const char c = text_.front();
    text_.remove_prefix(1);
    return static_cast<unsigned char>(c);
}

/// Sizes and blocks are encoded each for itself, so padding may be followed by more.
void VtpBytes::nextFour() {
    std::uint32_t bits = 0;
    std::size_t padding = 0;
    for (int taken = 0; taken < 4;) {
        const int c = nextCharacter();
        if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
        if (c < 0 || c == '<') fail("ends too early: its base64 stops where more bytes should be");
        const int value = c == '=' ? 0 : base64Value(static_cast<char>(c));
        if (c == '=') ++padding;
        if (value < 0 || padding > 2 || (padding > 0 && (taken < 2 || c != '='))) {
            const char character = static_cast<char>(c);
            fail("has " + shown({&character, 1}) + " where base64 should go on");
        }
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        ++taken;
    }
    for (std::size_t i = 0; i < 3; ++i) three_[i] = static_cast<std::byte>(bits >> (16 - 8 * i) & 255U);
    three_next_ = 0;
    three_count_ = 3 - padding;
}

void VtpBytes::stored(std::span<std::byte> out) {
    if (!base64_) {
        if (file_->read(out) < out.size()) fail("ends too early: the file ends within it");
        return;
    }
    for (std::byte& byte : out) {
        if (three_next_ == three_count_) nextFour();
        byte = three_[three_next_++];
    }
}

void VtpBytes::readSizes() {
    const std::uint64_t blocks = word();
    if (blocks == 0) return;
    block_bytes_ = word();
    last_bytes_ = word();
    if (blocks > room() / document_->word_bytes) {
        fail("claims " + std::to_string(blocks) + " blocks; the file has no room for their sizes");
    }
    if (block_bytes_ == 0 || last_bytes_ > block_bytes_) {
        fail("claims blocks of " + std::to_string(block_bytes_) + " bytes, the last of " + std::to_string(last_bytes_));
    }
    if (last_bytes_ == 0) last_bytes_ = block_bytes_;
    size_ = checkedAdd(checkedMultiply(blocks - 1, block_bytes_, document_->name()), last_bytes_, document_->name());
    packed_sizes_.resize(blocks);
    for (std::uint64_t& size : packed_sizes_) size = word();
}

void VtpBytes::nextBlock() {
    const std::string which = "block " + std::to_string(block_);
    const std::uint64_t packed = packed_sizes_.at(block_);
    const std::uint64_t bytes = block_ + 1 == packed_sizes_.size() ? last_bytes_ : block_bytes_;
    if (packed > room() || bytes / kDeflateRatioMax > packed) {
        fail("claims that its " + which + " of " + std::to_string(bytes) + " bytes takes " + std::to_string(packed) +
             "; the file has room for " + std::to_string(room()) + ", and zlib packs at most " +
             std::to_string(kDeflateRatioMax) + " to 1");
    }
    packed_.resize(packed);
    stored(packed_);
    expanded_.resize(bytes);
    uLongf length = bytes;
    const int status =
        uncompress(reinterpret_cast<Bytef*>(expanded_.data()), &length, reinterpret_cast<const Bytef*>(packed_.data()), packed);
    if (status != Z_OK || length != bytes) {
        fail("has a " + which + " that is no sound zlib data of " + std::to_string(bytes) + " bytes");
    }
    ++block_;
    in_block_ = 0;
}

void VtpBytes::read(std::span<std::byte> out) {
    if (out.size() > left_) fail("has " + std::to_string(size_) + " bytes; more are asked for by the lines");
    left_ -= out.size();
    if (!document_->zlib) return stored(out);
    while (!out.empty()) {
        if (in_block_ == expanded_.size()) nextBlock();
        const std::size_t step = std::min(out.size(), expanded_.size() - in_block_);
        std::memcpy(out.data(), expanded_.data() + in_block_, step);
        in_block_ += step;
        out = out.subspan(step);
    }
}

}  // namespace radiata::io
