// Numbers of one array of a .vtp file, however it is packed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/vtp_bytes.h"
#include "io/vtp_document.h"

namespace radiata::io {

/// From front to back.
class VtpNumbers {
public:
    /// \param array  lies in the document, which outlives this
    /// \param count  of numbers there have to be; unset: not known before they are read
    /// \throws Error(kCorrupt) if the array has another size, and as VtpBytes
    VtpNumbers(const VtpDocument& document, const VtpArray& array, std::optional<std::uint64_t> count);

    /// Appends `count` numbers. \throws Error(kCorrupt) if there are fewer or something else than numbers
    void read(std::uint64_t count, std::vector<float>& out);
    void skip(std::uint64_t count);
    /// A whole number. \throws as read()
    std::int64_t readId();

private:
    [[noreturn]] void fail(const std::string& what) const;
    std::string_view token();

    const VtpDocument* document_;
    const VtpArray* array_;
    std::string_view text_;  ///< not yet taken
    std::optional<VtpBytes> bytes_;
    std::vector<std::byte> stored_;
    std::vector<float> skipped_;
};

}  // namespace radiata::io
