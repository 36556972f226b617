// What a .vtp file (VTK XML PolyData) says about its arrays: where each lies and how it is packed.
// Format: VTK User's Guide, "VTK File Formats", "XML File Formats".
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/sample_type.h"

namespace radiata::io {

struct VtpArray {
    enum class Place {
        kText,      ///< numbers in the element, as text
        kBase64,    ///< bytes in the element
        kAppended,  ///< bytes at an offset of AppendedData
    };

    std::string name;
    SampleType type = SampleType::kFloat32;
    int components = 1;
    Place place = Place::kText;
    std::string_view text;     ///< of the element; lies in the document
    std::uint64_t offset = 0;  ///< appended: bytes of the file after the underscore
};

struct VtpPiece {
    std::uint64_t points = 0, lines = 0;
    std::uint64_t cells = 0;        ///< lines and all others: tuples of cell data
    std::uint64_t cells_ahead = 0;  ///< vertices, whose tuples come before those of lines
    VtpArray coordinates, ids, offsets;
    std::vector<VtpArray> point_data, cell_data;
};

/// Only moved: arrays refer to its text.
struct VtpDocument {
    VtpDocument() = default;
    VtpDocument(VtpDocument&&) = default;
    VtpDocument& operator=(VtpDocument&&) = default;

    std::filesystem::path path;
    bool swapped = false;          ///< bytes stand in the other order than this machine's
    std::size_t word_bytes = 4;    ///< of the sizes before an array's bytes
    bool zlib = false;             ///< arrays are compressed in blocks
    bool appended_base64 = false;  ///< else raw
    std::uint64_t appended = 0;    ///< where in the file appended data begin; 0: there are none
    std::vector<VtpPiece> pieces;
    std::string space;    ///< what comments and the field SPACE say about the axes
    std::string remarks;  ///< arrays that are left out
    std::vector<char> xml;

    std::string name() const { return path.filename().string(); }
};

/// Takes memory for everything before the appended data. \throws Error(kCorrupt) for what contradicts the format,
/// (kUnsupported) for other datasets than PolyData and other compressors than zlib, (kResourceExhausted) for more than 4 GiB
/// before the appended data
VtpDocument readVtpDocument(const std::filesystem::path& path);

}  // namespace radiata::io
