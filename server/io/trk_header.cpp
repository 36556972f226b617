#include "io/trk_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "io/text.h"

namespace radiata::io {
namespace {

constexpr std::size_t kHeaderBytes = 1000, kNameBytes = 20, kNames = 10;
// Offsets of the fields.
constexpr std::size_t kDim = 6, kVoxelSize = 12, kScalarCount = 36, kScalarNames = 38, kPropertyCount = 238,
                      kPropertyNames = 240, kMatrix = 440, kVoxelOrder = 948, kTrackCount = 988, kVersion = 992,
                      kHeaderSize = 996;

class Fields {
public:
    Fields(const std::array<std::byte, kHeaderBytes>& bytes, bool swapped) : bytes_(bytes), swapped_(swapped) {}

    template <typename T>
    T at(std::size_t offset) const {
        std::array<std::byte, sizeof(T)> own;
        std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(T), own.begin());
        if (swapped_) std::reverse(own.begin(), own.end());
        T value;
        std::memcpy(&value, own.data(), sizeof(T));
        return value;
    }

    std::string text(std::size_t offset, std::size_t length) const {
        return {reinterpret_cast<const char*>(bytes_.data()) + offset, length};
    }

private:
    const std::array<std::byte, kHeaderBytes>& bytes_;
    bool swapped_;
};

/// One column for each name; numbers without a name are one column together.
std::vector<model::ColumnName> columnsOf(const Fields& fields, std::size_t names, int count, const std::string& rest,
                                         const std::string& file) {
    std::vector<model::ColumnName> columns;
    int named = 0;
    for (std::size_t i = 0; i < kNames && named < count; ++i) {
        const std::string slot = fields.text(names + i * kNameBytes, kNameBytes);
        std::string name = slot.substr(0, slot.find('\0'));
        if (name.empty()) continue;
        int components = 1;
        const std::string after = name.size() + 1 < slot.size() ? slot.substr(name.size() + 1) : "";
        if (!after.empty() && after.front() >= '1' && after.front() <= '9') {
            std::from_chars(after.data(), after.data() + after.size(), components);
        }
        components = std::min(components, count - named);
        const auto same = [&](const model::ColumnName& column) { return column.name == name; };
        for (int n = 2; std::any_of(columns.begin(), columns.end(), same); ++n) {
            name = slot.substr(0, slot.find('\0')) + "_" + std::to_string(n);
        }
        columns.push_back({name, components});
        named += components;
    }
    if (named < count) columns.push_back({rest, count - named});
    if (columns.size() > 1 && columns.back().name == rest) {
        const auto twice = std::count_if(columns.begin(), columns.end(), [&](const auto& c) { return c.name == rest; });
        if (twice > 1) throw Error(Code::kCorrupt, file + ": the header names a column '" + rest + "' twice");
    }
    return columns;
}

/// The world axis (0 to 2) that each voxel axis follows, and its direction.
struct Orientation {
    std::array<int, 3> axis{};
    std::array<int, 3> sign{};
};

Orientation orientationOf(const glm::dmat4& matrix, const std::string& file) {
    Orientation found;
    std::array<bool, 3> column_done{}, row_done{};
    for (int step = 0; step < 3; ++step) {
        double best = 0;
        int c = -1, r = -1;
        for (int column = 0; column < 3; ++column) {
            const double length = glm::length(glm::dvec3(matrix[column]));
            for (int row = 0; row < 3; ++row) {
                const double part = length > 0 ? std::abs(matrix[column][row]) / length : 0;
                if (column_done[column] || row_done[row] || !(part > best)) continue;
                best = part;
                c = column;
                r = row;
            }
        }
        if (c < 0) {
            throw Error(Code::kCorrupt, file +
                                            ": the header's vox_to_ras matrix is singular or not finite; its columns must be "
                                            "three directions");
        }
        column_done[c] = row_done[r] = true;
        found.axis[c] = r;
        found.sign[c] = matrix[c][r] < 0 ? -1 : 1;
    }
    return found;
}

Orientation orientationNamed(const std::string& letters, const std::string& file) {
    const std::string negative = "LPI", positive = "RAS";
    Orientation named;
    int seen = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letters[i])));
        const std::size_t minus = negative.find(letter), plus = positive.find(letter);
        if (minus == negative.npos && plus == positive.npos) seen = 8;
        named.axis[i] = static_cast<int>(minus != negative.npos ? minus : plus);
        named.sign[i] = minus != negative.npos ? -1 : 1;
        if (seen != 8) seen |= 1 << named.axis[i];
    }
    if (seen != 7) {
        throw Error(Code::kCorrupt, file + ": the header's voxel order is " + shown(letters) +
                                        "; it must be three letters, one each of L/R, P/A and I/S");
    }
    return named;
}

/// From voxel indices along the header's axes to voxel indices along the matrix' columns.
glm::dmat4 betweenOrders(const Orientation& header, const Orientation& matrix, const glm::ivec3& dim) {
    glm::dmat4 map(0.0);
    map[3][3] = 1;
    for (int i = 0; i < 3; ++i) {
        const int j = static_cast<int>(std::find(matrix.axis.begin(), matrix.axis.end(), header.axis[i]) - matrix.axis.begin());
        const bool same = header.sign[i] == matrix.sign[j];
        map[i][j] = same ? 1 : -1;
        map[3][j] = same ? 0 : dim[i] - 1;
    }
    return map;
}

bool isFinite(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            if (!std::isfinite(m[c][r])) return false;
        }
    }
    return true;
}

int countAt(const Fields& fields, std::size_t offset, const char* field, const std::string& file) {
    const int count = fields.at<std::int16_t>(offset);
    if (count < 0) {
        throw Error(Code::kCorrupt, file + ": the header's " + std::string(field) + " is " + std::to_string(count) +
                                        "; it must not be negative");
    }
    return count;
}

void placeTracks(TrkHeader& header, const Fields& fields, int version) {
    model::TractogramHeader& tracts = header.tractogram;
    const std::string& file = tracts.source;
    glm::dvec3 voxel(fields.at<float>(kVoxelSize), fields.at<float>(kVoxelSize + 4), fields.at<float>(kVoxelSize + 8));
    if (voxel == glm::dvec3(0)) {
        tracts.remarks += "The header's voxel size is 0; 1 mm is assumed. ";
        voxel = glm::dvec3(1);
    }
    for (int i = 0; i < 3; ++i) {
        if (!(voxel[i] > 0 && voxel[i] < 1e6)) {
            throw Error(Code::kCorrupt,
                        file + ": the header's voxel size is " + std::to_string(voxel[i]) + " mm; it must be positive");
        }
        tracts.grid_size[i] = fields.at<std::int16_t>(kDim + 2 * static_cast<std::size_t>(i));
    }
    glm::dmat4 matrix(0.0);
    for (int r = 0; r < 4 && version >= 2; ++r) {
        for (int c = 0; c < 4; ++c) matrix[c][r] = fields.at<float>(kMatrix + 4 * static_cast<std::size_t>(4 * r + c));
    }
    if (matrix[3][3] == 0) {
        tracts.remarks += "The header has no vox_to_ras matrix; the identity is assumed. ";
        matrix = glm::dmat4(1.0);
    }
    if (!isFinite(matrix)) throw Error(Code::kCorrupt, file + ": the header's vox_to_ras matrix is not finite");
    std::string order = fields.text(kVoxelOrder, 3);
    if (order.front() == '\0') {
        tracts.remarks += "The header names no voxel order; LPS is assumed. ";
        order = "LPS";
    }
    const Orientation own = orientationOf(matrix, file);
    const glm::dmat4 reorder = betweenOrders(orientationNamed(order, file), own, tracts.grid_size);
    glm::dmat4 to_voxel(1.0);
    for (int i = 0; i < 3; ++i) {
        to_voxel[i][i] = 1 / voxel[i];
        to_voxel[3][i] = -0.5;
    }
    header.to_world = matrix * reorder * to_voxel;
    tracts.voxel_to_world = matrix;
}

}  // namespace

TrkHeader readTrkHeader(ByteSource& source) {
    const std::string file = source.name();
    std::array<std::byte, kHeaderBytes> bytes{};
    const std::size_t got = source.read(bytes);
    if (got < kHeaderBytes) {
        throw Error(Code::kCorrupt,
                    file + ": the file ends after " + std::to_string(got) + " bytes, within the header of 1000");
    }
    if (std::memcmp(bytes.data(), "TRACK", 5) != 0) {
        throw Error(Code::kCorrupt, file + ": begins with " + shown(Fields(bytes, false).text(0, 5)) + ", not with 'TRACK'");
    }
    TrkHeader header;
    const auto size = Fields(bytes, false).at<std::int32_t>(kHeaderSize);
    header.swapped = size != static_cast<std::int32_t>(kHeaderBytes);
    const Fields fields(bytes, header.swapped);
    if (fields.at<std::int32_t>(kHeaderSize) != static_cast<std::int32_t>(kHeaderBytes)) {
        throw Error(Code::kCorrupt, file + ": the header's size is given as " + std::to_string(size) +
                                        "; it must be 1000 in one byte order or the other");
    }
    const auto version = fields.at<std::int32_t>(kVersion);
    if (version < 1 || version > 3) {
        throw Error(Code::kUnsupported, file + ": is of version " + std::to_string(version) + "; versions 1 to 3 are read");
    }
    model::TractogramHeader& tracts = header.tractogram;
    tracts.source = file;
    tracts.format = "trk";
    const int scalars = countAt(fields, kScalarCount, "n_scalars", file);
    const int properties = countAt(fields, kPropertyCount, "n_properties", file);
    header.scalars = static_cast<std::size_t>(scalars);
    header.properties = static_cast<std::size_t>(properties);
    tracts.vertex_columns = columnsOf(fields, kScalarNames, scalars, "scalars", file);
    tracts.fibre_columns = columnsOf(fields, kPropertyNames, properties, "properties", file);
    const auto count = fields.at<std::int32_t>(kTrackCount);
    if (count > 0) tracts.fibre_count = static_cast<std::uint64_t>(count);
    placeTracks(header, fields, version);
    return header;
}

}  // namespace radiata::io
