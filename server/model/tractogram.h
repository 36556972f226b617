// Streamlines ("fibres") as every reader delivers them, whatever the file: points in scanner millimetres, columns of values per
// fibre and per vertex, and named groups. A file may be larger than the memory, so readers are a TractogramSource that hands
// out batch after batch; a Tractogram is what all batches together make, for what fits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace radiata::model {

/// Fibres are numbered with 32 bits, on the device too; the last number stands for "none".
inline constexpr std::uint64_t kFibreCountMax = 0xffffffffULL;
/// Coordinates farther from the origin than this are damage, not anatomy.
inline constexpr float kCoordinateMaxMm = 100'000;

/// What one column is called and how many numbers it has per fibre or per vertex.
struct ColumnName {
    std::string name;  ///< UTF-8, not empty, unique among the columns of its kind
    int components = 1;
    bool operator==(const ColumnName&) const = default;
};

/// What is known before any point is read.
struct TractogramHeader {
    std::string source;  ///< file name for messages
    std::string format;  ///< "tck", "trk", "trx", "vtk", "tt", "fiblet", "memory", ...
    /// As the file says; absent if it does not, and a hint only: some programs write wrong counts.
    std::optional<std::uint64_t> fibre_count, point_count;
    std::vector<ColumnName> vertex_columns, fibre_columns;
    /// Of the image that was tracked, if the file names one: voxels along i, j, k and voxel centres to world mm.
    glm::ivec3 grid_size{0};
    std::optional<glm::dmat4> voxel_to_world;
    std::string remarks;  ///< what had to be assumed about the file, as sentences; empty if nothing
};

/// Consecutive fibres. Fibre f has the points [offsets[f], offsets[f + 1]); it may have one or none, and points may repeat.
/// All coordinates are finite and at most kCoordinateMaxMm.
struct FibreBatch {
    std::uint64_t first_fibre = 0;                  ///< number of fibre 0 in the whole tractogram
    std::uint64_t first_point = 0;                  ///< number of point 0 in the whole tractogram
    std::vector<glm::vec3> points;                  ///< world mm, RAS
    std::vector<std::uint64_t> offsets{0};          ///< fibreCount() + 1, ascending, from 0 to points.size()
    std::vector<std::vector<float>> vertex_values;  ///< for each vertex column points.size() * components, point by point
    std::vector<std::vector<float>> fibre_values;   ///< for each fibre column fibreCount() * components; NaN: no value

    std::size_t fibreCount() const { return offsets.size() - 1; }
    std::span<const glm::vec3> fibre(std::size_t f) const {
        return std::span(points).subspan(offsets[f], offsets[f + 1] - offsets[f]);
    }
    /// Empties it, keeping the memory, for a header with so many columns.
    void clear(std::size_t vertex_columns, std::size_t fibre_columns);
};

/// A named list of fibres; groups may overlap.
struct FibreGroup {
    std::string name;
    std::vector<std::uint32_t> fibres;       ///< ascending, each below the fibre count
    std::vector<ColumnName> columns;         ///< values of the group as a whole
    std::vector<std::vector<float>> values;  ///< for each column its components
};

/// What reading all points tells.
struct TractogramMeasures {
    std::uint64_t fibres = 0, points = 0, segments = 0;
    std::uint64_t empty_fibres = 0;    ///< without any point; those left out for bad coordinates are among them
    std::uint64_t damaged_fibres = 0;  ///< left out for coordinates that are not finite or too large; they keep their number
    std::uint64_t longest_fibre_points = 0;
    double length_mm = 0, longest_fibre_mm = 0;
    glm::vec3 bounds_min{std::numeric_limits<float>::infinity()};  ///< world mm; empty (min > max) without points
    glm::vec3 bounds_max{-std::numeric_limits<float>::infinity()};
    double shortest_segment_mm = std::numeric_limits<double>::infinity();  ///< each fibre's last segment apart
    double longest_segment_mm = 0;
    double inner_length_mm = 0;  ///< sum of the segments that are not their fibre's last
    std::uint64_t inner_segments = 0;

    void add(const FibreBatch& batch);
    /// The step that all segments share but for each fibre's last, which may be shorter; 0 if it varies by more than 1 %, apart
    /// from what rounding the coordinates to float can do.
    double constantStepMm() const;
};

/// Fibres one after another, once. Not thread-safe.
class TractogramSource {
public:
    virtual ~TractogramSource() = default;

    virtual const TractogramHeader& header() const = 0;
    /// Replaces the batch by the next fibres: whole ones, until `points_wanted` are reached or passed.
    /// \return false, and an empty batch, after the last fibre
    /// \throws Error(kCorrupt, kUnavailable, kResourceExhausted) naming file, place, value and what would be right
    virtual bool read(FibreBatch& batch, std::size_t points_wanted) = 0;
    /// All groups; to be called after read() has returned false.
    virtual std::vector<FibreGroup> groups() { return {}; }
    /// Fibres so far that were left out for their coordinates: they are delivered without points.
    virtual std::uint64_t damagedFibres() const { return 0; }
    /// Bytes of the file read so far and all of them, for progress; 0 if unknown.
    virtual std::uint64_t bytesRead() const { return 0; }
    virtual std::uint64_t bytesTotal() const { return 0; }
};

/// A whole tractogram in memory: one batch with everything.
struct Tractogram {
    TractogramHeader header;  ///< counts are set and right
    FibreBatch fibres;        ///< first_fibre and first_point are 0
    std::vector<FibreGroup> groups;
    TractogramMeasures measures;

    std::size_t fibreCount() const { return fibres.fibreCount(); }
    std::span<const glm::vec3> fibre(std::size_t f) const { return fibres.fibre(f); }
    /// Index of the column of that name. \throws Error(kNotFound) naming the columns there are
    std::size_t fibreColumn(const std::string& name) const;
    std::size_t vertexColumn(const std::string& name) const;
    /// \throws Error(kNotFound) naming the groups there are
    const FibreGroup& group(const std::string& name) const;
};

/// Appends a batch's fibres, points and columns to another with the same columns.
void append(FibreBatch& to, const FibreBatch& batch);

/// Reads everything. \throws as TractogramSource::read(); Error(kResourceExhausted) beyond `bytes_max` of points and values
Tractogram readAll(TractogramSource& source, std::uint64_t bytes_max = std::numeric_limits<std::uint64_t>::max());

/// Hands out a tractogram that outlives the source, for whatever takes a source.
std::unique_ptr<TractogramSource> sourceOf(const Tractogram& tractogram);

}  // namespace radiata::model
