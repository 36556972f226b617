// MRtrix3 track files, read batch by batch and written.
// Format: MRtrix3 documentation, "Tracks file format (.tck)": triplets, a NaN one ends a track, an infinite one the file.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "io/byte_source.h"
#include "io/tck_header.h"
#include "model/tractogram.h"

namespace radiata::io {

/// .tck or .tck.gz. A track without points is a fibre without points. Numbers beside the last track's NaN triplet that are
/// followed by the end triplet make a fibre, too.
/// \throws Error(kCorrupt) if the end triplet is missing, naming fibre and offset, and as readTckHeader() and ByteSource
std::unique_ptr<model::TractogramSource> openTck(const std::filesystem::path& path);

/// Values of a .tsf file (whose end mark MRtrix3 leaves out), track after track, or those of a .tck file as they stand (three
/// numbers each).
class TckNumbers {
public:
    /// \param width  numbers per vertex: 3 for tracks, 1 for scalars
    TckNumbers(const std::filesystem::path& path, const std::string& magic, std::size_t width);

    const TckHeader& header() const { return header_; }
    const ByteSource& source() const { return source_; }
    /// The next numbers in native floats, whole vertices only; empty at the end of the file's content.
    std::span<const float> buffered();
    /// Vertices that were taken from the front of buffered().
    void take(std::size_t vertices) { next_ += vertices * width_; }
    /// \throws Error(kCorrupt) with the offset: the file ended before its end mark
    [[noreturn]] void failCutOff(std::uint64_t fibre) const;

private:
    std::size_t width_;
    ByteSource source_;
    TckHeader header_;
    std::vector<float> numbers_;
    std::vector<std::byte> stored_;
    std::size_t next_ = 0;
};

/// Writes Float32LE, fibre by fibre. Vertex columns go to BASE_NAME.tsf beside it and fibre columns to BASE_NAME.txt, where
/// BASE is the file's name without .tck, if `columns` is set; of columns with several components one file for each
/// (BASE_NAME_0.tsf). A file that cannot be finished is removed. Equal fibres give equal bytes.
/// \return the files written.  \throws Error(kUnavailable, kResourceExhausted) if writing fails
std::vector<std::filesystem::path> writeTck(model::TractogramSource& source, const std::filesystem::path& path,
                                            bool columns = true);

}  // namespace radiata::io
