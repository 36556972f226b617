#include "io/vtp_numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>

#include "base/checked.h"
#include "base/error.h"
#include "io/text.h"

namespace radiata::io {
namespace {

constexpr std::string_view kBetween = " \t\r\n";
constexpr std::size_t kBlockNumbers = std::size_t{1} << 14;

bool isSigned(SampleType type) {
    return type == SampleType::kInt8 || type == SampleType::kInt16 || type == SampleType::kInt32 || type == SampleType::kInt64;
}

}  // namespace

VtpNumbers::VtpNumbers(const VtpDocument& document, const VtpArray& array, std::optional<std::uint64_t> count)
    : document_(&document), array_(&array), text_(array.text) {
    if (array.place == VtpArray::Place::kText) {
        if (count && *count > (text_.size() + 1) / 2) {
            fail("should have " + std::to_string(*count) + " numbers; its text has " + std::to_string(text_.size()) +
                 " characters");
        }
        return;
    }
    if (count == 0) return;
    bytes_.emplace(document, array);
    if (!count) return;
    const std::uint64_t wanted = checkedMultiply(*count, bitsOf(array.type) / 8, document.name());
    if (bytes_->size() != wanted) {
        fail("has " + std::to_string(bytes_->size()) + " bytes; the " + std::to_string(*count) +
             " numbers that the piece should have take " + std::to_string(wanted));
    }
}

void VtpNumbers::fail(const std::string& what) const {
    throw Error(Code::kCorrupt, document_->name() + ": the array " + shown(array_->name) + " " + what);
}

std::string_view VtpNumbers::token() {
    const std::size_t first = text_.find_first_not_of(kBetween);
    if (first == text_.npos) fail("ends too early: more numbers should be there");
    const std::size_t end = std::min(text_.find_first_of(kBetween, first), text_.size());
    const std::string_view word = text_.substr(first, end - first);
    text_.remove_prefix(end);
    return word;
}

void VtpNumbers::read(std::uint64_t count, std::vector<float>& out) {
    while (count > 0 && bytes_) {
        const auto block = static_cast<std::size_t>(std::min<std::uint64_t>(count, kBlockNumbers));
        stored_.resize(block * bitsOf(array_->type) / 8);
        bytes_->read(stored_);
        const std::size_t before = out.size();
        out.resize(before + block);
        decodeSamples(array_->type, document_->swapped, 1, 0, stored_, std::span(out).subspan(before));
        count -= block;
    }
    for (; count > 0; --count) {
        const std::string_view word = token();
        double value = 0;
        const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (failure == std::errc::invalid_argument || end != word.data() + word.size()) {
            fail("has " + shown(word) + ", which is no number");
        }
        out.push_back(static_cast<float>(value));
    }
}

void VtpNumbers::skip(std::uint64_t count) {
    while (count > 0) {
        const std::uint64_t step = std::min<std::uint64_t>(count, kBlockNumbers);
        skipped_.clear();
        read(step, skipped_);
        count -= step;
    }
}

std::int64_t VtpNumbers::readId() {
    if (!bytes_) {
        const std::string_view word = token();
        std::int64_t value = 0;
        const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (failure != std::errc() || end != word.data() + word.size()) {
            fail("has " + shown(word) + ", which is no whole number");
        }
        return value;
    }
    std::array<std::byte, 8> all{};
    const std::span<std::byte> own = std::span(all).first(bitsOf(array_->type) / 8);
    bytes_->read(own);
    const bool big = document_->swapped != (std::endian::native == std::endian::big);
    if (big) std::reverse(own.begin(), own.end());
    std::uint64_t joined = 0;
    for (std::size_t i = 0; i < own.size(); ++i) joined |= std::to_integer<std::uint64_t>(own[i]) << (8 * i);
    const std::size_t bits = 8 * own.size();
    if (bits < 64 && isSigned(array_->type) && (joined >> (bits - 1)) != 0) joined |= ~std::uint64_t{0} << bits;
    return static_cast<std::int64_t>(joined);
}

}  // namespace radiata::io
