// Illumination lattices that were computed to the end, as files; docs/formats/lattice.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/byte_source.h"
#include "io/write_file.h"

namespace radiata::io {

constexpr std::size_t kTexelsPerBrick = 64;  ///< 4^3

/// What a file says about itself. Two lattices with equal keys keep the same numbers.
struct LatticeHeader {
    std::string key;                  ///< in words: volume, settings and, of irradiance, the light
    std::uint32_t payload_bytes = 0;  ///< of one texel, 4 to 4096, a multiple of 4
    std::uint64_t bricks = 0;         ///< of kTexelsPerBrick texels, that the file holds
    bool operator==(const LatticeHeader&) const = default;
};

/// Some bricks of a lattice: for each its number, then as many states and payloads as a brick has texels.
struct LatticePart {
    static constexpr std::size_t kBricksMax = 512;
    std::vector<std::uint32_t> bricks;  ///< 1 to kBricksMax
    std::vector<std::uint32_t> states;  ///< shader::LatticeParams says what they mean
    std::vector<std::byte> payloads;
};

/// Writes part by part; the file appears under its name when finish() returns.
class LatticeWriter {
public:
    /// \throws Error(kUnavailable) if it cannot be created
    LatticeWriter(const std::filesystem::path& path, const LatticeHeader& header);
    /// \throws Error(kUnavailable) naming the reason, such as a full disk
    void write(const LatticePart& part);
    /// \throws Error(kInternal) if other than header.bricks were written, Error(kUnavailable)
    void finish();

private:
    LatticeHeader header_;
    WriteFile file_;
    std::uint64_t written_ = 0;
};

/// Reads part by part and checks each before it gives it.
class LatticeReader {
public:
    /// \throws Error(kNotFound, kUnavailable) if it cannot be opened, (kCorrupt) naming what contradicts what, (kUnsupported)
    /// for
    ///         another version
    explicit LatticeReader(const std::filesystem::path& path);
    const LatticeHeader& header() const { return header_; }
    /// The next part, or nothing at the end. \param bricks  of the whole lattice: numbers are below it
    /// \throws Error(kCorrupt)
    std::optional<LatticePart> read(std::uint64_t bricks);

private:
    ByteSource file_;
    LatticeHeader header_;
    std::uint64_t read_ = 0;
};

/// A whole lattice in host memory.
struct SavedLattice {
    std::string name;  ///< of its file
    LatticeHeader header;
    std::vector<LatticePart> parts;  ///< each brick once
};

/// \param wanted  what the file must say of itself: nothing is read of another
/// \throws as LatticeReader, Error(kInvalidArgument) for a lattice of something else, Error(kCorrupt) for a brick that is there
/// twice
SavedLattice readLattice(const std::filesystem::path& path, const LatticeHeader& wanted);

}  // namespace radiata::io
