// Writing a .fiblet file (docs/formats/fiblet.md) piece by piece, for content that does not fit the memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "io/fiblet_layout.h"
#include "io/write_file.h"
#include "model/fiblet_set.h"

namespace radiata::io {

/// What must be known before the first page, because it says where everything goes.
struct FibletCounts {
    std::uint64_t fibres = 0, fiblets = 0, words = 0;
};

/// The kinds of content may come in any order among each other; each kind comes from front to back.
class FibletWriter {
public:
    /// \param set  codec, origin, errors, points, names of columns, groups; its fiblets and columns' values are not looked at
    /// \throws Error(kUnavailable) if the file cannot be created or written, here and below
    FibletWriter(const std::filesystem::path& path, const model::FibletSet& set, const FibletCounts& counts);

    /// The next pages: heads, codes (with one word behind them), pages that count words from the first of these, and point
    /// columns. Only the last call may bring a page that is not full.
    void addPages(const model::FibletSet& set);
    void addFibreFirst(std::span<const std::uint32_t> numbers);
    void addFibreFiblets(std::span<const std::uint32_t> heads);
    void addFibreColumn(std::size_t column, std::span<const float> values);
    /// The file gets its name. \throws Error(kInternal) if content is missing
    void finish();

private:
    struct Stream {
        std::uint64_t at = 0, left = 0, bytes = 0;
        std::uint32_t crc = 0;
    };
    /// Of a section: bytes known from the beginning, then those of two streams.
    struct Part {
        std::vector<std::byte> own;
        Stream first, second;
    };
    void add(std::uint32_t kind, std::vector<std::byte> own, std::uint64_t first, std::uint64_t second = 0);
    void place();
    void put(Stream& stream, std::span<const std::byte> bytes);

    WriteFile file_;
    fiblet::Header header_;
    std::vector<fiblet::Section> sections_;
    std::vector<Part> parts_;
    std::size_t columns_, fibre_columns_ = 0, point_columns_ = 0;
    std::uint64_t words_ = 0;
};

}  // namespace radiata::io
