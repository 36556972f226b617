// Track files put together byte by byte, sharing no code with the readers.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "unit/io/image_bytes.h"

namespace radiata::test {

using Triplets = std::vector<std::array<double, 3>>;

inline const double kNanNumber = std::numeric_limits<double>::quiet_NaN();
inline const double kInfNumber = std::numeric_limits<double>::infinity();

inline std::vector<double> flat(const Triplets& triplets) {
    std::vector<double> numbers;
    for (const auto& t : triplets) numbers.insert(numbers.end(), t.begin(), t.end());
    return numbers;
}

/// A .tck or .tsf file: the lines, END, and the numbers as they stand.
inline std::string tckBytes(const std::vector<std::string>& lines, const std::vector<double>& numbers,
                            const std::string& type = "float32", bool big = false, std::size_t offset = 200) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    text += "END\n";
    if (offset > 0) text.resize(offset, '\0');
    return text + encode(numbers, type, big);
}

/// Two tracks of 3 and 1 points, in tck's way, with the end mark.
inline std::vector<double> twoTracks() {
    return flat({{1, 2, 3},
                 {1.5, 2, 3},
                 {2, 2.25, 3},
                 {kNanNumber, kNanNumber, kNanNumber},
                 {-7, 8, -9},
                 {kNanNumber, kNanNumber, kNanNumber},
                 {kInfNumber, kInfNumber, kInfNumber}});
}

inline std::vector<std::string> tckLines(const std::string& type = "Float32LE", const std::string& count = "2") {
    return {"mrtrix tracks", "datatype: " + type, "count: " + count, "file: . 200"};
}

struct TrkFile {
    bool big = false;
    std::array<double, 3> dim{10, 20, 30}, voxel{2, 2, 2};
    std::vector<std::string> scalar_names, property_names;  ///< 20 bytes each at most
    std::optional<int> scalars, properties;                 ///< unset: as many as names
    std::array<double, 16> matrix{2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1};
    std::string order = "RAS";
    int count = 0, version = 2, header_size = 1000;
    std::string data;  ///< tracks (trkTrack)
};

inline void put(std::string& bytes, std::size_t at, const std::string& value) { bytes.replace(at, value.size(), value); }

inline std::string trkBytes(const TrkFile& file) {
    std::string bytes(1000, '\0');
    const auto number = [&](double value, const char* type) { return encode({value}, type, file.big); };
    put(bytes, 0, "TRACK");
    for (std::size_t i = 0; i < 3; ++i) {
        put(bytes, 6 + 2 * i, number(file.dim[i], "int16"));
        put(bytes, 12 + 4 * i, number(file.voxel[i], "float32"));
    }
    const auto names = [&](std::size_t at, std::optional<int> count, const std::vector<std::string>& list) {
        put(bytes, at, number(static_cast<double>(count.value_or(static_cast<int>(list.size()))), "int16"));
        for (std::size_t i = 0; i < list.size(); ++i) put(bytes, at + 2 + 20 * i, list[i]);
    };
    names(36, file.scalars, file.scalar_names);
    names(238, file.properties, file.property_names);
    for (std::size_t i = 0; i < 16; ++i) put(bytes, 440 + 4 * i, number(file.matrix[i], "float32"));
    put(bytes, 948, file.order);
    put(bytes, 988, number(file.count, "int32"));
    put(bytes, 992, number(file.version, "int32"));
    put(bytes, 996, number(file.header_size, "int32"));
    return bytes + file.data;
}

/// One track: its count and its numbers, vertex by vertex, then its properties.
inline std::string trkTrack(int points, const std::vector<double>& numbers, bool big = false) {
    return encode({static_cast<double>(points)}, "int32", big) + encode(numbers, "float32", big);
}

/// A matrix of a MATLAB 4 file. \param type  0 float64, 10 float32, 20 int32, 30 int16, 50 uint8
inline std::string matMatrix(const std::string& name, int type, std::size_t count, const std::string& bytes) {
    return encode({static_cast<double>(type), 1, static_cast<double>(count), 0, static_cast<double>(name.size() + 1)}, "int32",
                  false) +
           name + '\0' + bytes;
}

/// One TinyTrack: first point and steps in 1/32 voxel.
inline std::string ttTrack(const std::array<double, 3>& first, const Triplets& steps) {
    return encode({static_cast<double>(3 * (steps.size() + 1))}, "uint32", false) +
           encode({first[0], first[1], first[2]}, "int32", false) + encode(flat(steps), "int8", false);
}

/// A whole .tt file of one track of 3 points and one of 1, placed by a matrix with 2 mm voxels.
inline std::string ttBytes() {
    const std::string tracks = ttTrack({32, 64, -32}, {{16, 0, 0}, {0, -8, 4}}) + ttTrack({320, 0, 0}, {});
    return matMatrix("dimension", 20, 3, encode({10, 20, 30}, "int32", false)) +
           matMatrix("voxel_size", 10, 3, encode({2, 2, 2}, "float32", false)) +
           matMatrix("trans_to_mni", 10, 16, encode({-2, 0, 0, 78, 0, -2, 0, 76, 0, 0, 2, -50, 0, 0, 0, 1}, "float32", false)) +
           matMatrix("track", 50, tracks.size(), tracks);
}

/// A text .vtk file of two lines through five points, with a column of each kind.
inline std::string vtkText(const std::string& title = "two lines") {
    return "# vtk DataFile Version 3.0\n" + title +
           "\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n1 2 3 1.5 2 3\n2 2 3\n-7 8 -9 -7 8.5 -9\n"
           "LINES 2 7\n3 0 1 2\n2 3 4\nPOINT_DATA 5\nSCALARS fa float 1\nLOOKUP_TABLE default\n0.1 0.2 0.3 0.4 0.5\n"
           "CELL_DATA 2\nFIELD FieldData 1\nid 2 2 int\n1 2 3 4\n";
}

/// The same lines in binary, of version 3.0 or, with offsets, of 5.1.
inline std::string vtkBinary(bool offsets) {
    std::string bytes = "# vtk DataFile Version " + std::string(offsets ? "5.1" : "3.0") +
                        "\nvtk output\nBINARY\nDATASET POLYDATA\nPOINTS 5 double\n" +
                        encode({1, 2, 3, 1.5, 2, 3, 2, 2, 3, -7, 8, -9, -7, 8.5, -9}, "float64", true);
    if (offsets) {
        bytes += "\nLINES 3 5\nOFFSETS vtktypeint64\n" + encode({0, 3, 5}, "int64", true) + "\nCONNECTIVITY vtktypeint64\n" +
                 encode({0, 1, 2, 3, 4}, "int64", true);
    } else {
        bytes += "\nLINES 2 7\n" + encode({3, 0, 1, 2, 2, 3, 4}, "int32", true);
    }
    return bytes + "\nPOINT_DATA 5\nSCALARS fa float 1\nLOOKUP_TABLE default\n" +
           encode({0.1, 0.2, 0.3, 0.4, 0.5}, "float32", true) + "\nCELL_DATA 2\nFIELD FieldData 1\nid 2 2 int\n" +
           encode({1, 2, 3, 4}, "int32", true) + "\n";
}

}  // namespace radiata::test
