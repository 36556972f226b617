// Where the arrays of a legacy VTK file lie, and numbers from any of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/byte_source.h"
#include "io/sample_type.h"

namespace radiata::io {

struct VtkArray {
    std::string name;
    SampleType type = SampleType::kFloat32;
    std::uint64_t begin = 0;  ///< offset of the first number
    std::uint64_t tuples = 0;
    int components = 1;
};

struct VtkSections {
    std::string title;
    bool text = false;
    std::optional<VtkArray> points;        ///< 3 components
    std::optional<VtkArray> cells;         ///< counts and ids in turn
    std::optional<VtkArray> offsets, ids;  ///< of newer files, in place of cells
    std::uint64_t lines = 0;
    std::uint64_t other_cells = 0;  ///< vertices, polygons and strips
    std::vector<VtkArray> point_data, cell_data;
    std::string remarks;
};

/// Goes through the whole file once. \throws Error(kCorrupt, kUnsupported) naming keyword and offset
VtkSections readVtkSections(const std::filesystem::path& path);

/// Numbers of one array from front to back; big-endian if binary, as all legacy files are.
class VtkNumbers {
public:
    VtkNumbers(const std::filesystem::path& path, bool text, const VtkArray& array);

    /// Appends `count` numbers. \throws Error(kCorrupt) naming the offset
    void read(std::uint64_t count, std::vector<float>& out);
    std::int64_t readId();
    std::uint64_t bytesRead() const { return source_.fileBytesRead(); }

private:
    std::string token();

    ByteSource source_;
    VtkArray array_;
    bool text_;
    std::vector<std::byte> stored_;
    std::vector<char> ahead_;
    std::size_t next_ = 0;
};

}  // namespace radiata::io
