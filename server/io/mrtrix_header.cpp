#include "io/mrtrix_header.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

#include "base/error.h"
#include "io/byte_source.h"
#include "io/data_file.h"
#include "io/mrtrix_text.h"
#include "io/text.h"
#include "math/cartesian_tensor.h"

namespace radiata::io {
namespace {

constexpr std::size_t kAxesMax = 16;

struct StoredType {
    SampleType type;
    bool swapped;
};

StoredType sampleType(const MrtrixText& text) {
    static constexpr std::array<std::pair<std::string_view, SampleType>, 11> kTypes{{
        {"bit", SampleType::kBit},
        {"int8", SampleType::kInt8},
        {"uint8", SampleType::kUInt8},
        {"int16", SampleType::kInt16},
        {"uint16", SampleType::kUInt16},
        {"int32", SampleType::kInt32},
        {"uint32", SampleType::kUInt32},
        {"int64", SampleType::kInt64},
        {"uint64", SampleType::kUInt64},
        {"float32", SampleType::kFloat32},
        {"float64", SampleType::kFloat64},
    }};
    const std::string written = text.only("datatype");
    std::string name = written;
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    bool big = std::endian::native == std::endian::big;
    const bool ordered = name.ends_with("le") || name.ends_with("be");
    if (ordered) {
        big = name.ends_with("be");
        name.resize(name.size() - 2);
    }
    for (const auto& [known, type] : kTypes) {
        if (name != known || (ordered && bitsOf(type) <= 8)) continue;
        return {type, bitsOf(type) > 8 && big != (std::endian::native == std::endian::big)};
    }
    throw Error(Code::kUnsupported,
                text.file() + ": datatype is " + shown(written) +
                    (name.starts_with("cfloat") ? ", complex numbers, which are not read" : "") +
                    "; Bit, Int8, UInt8 and Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 with LE or BE are");
}

/// Order of the axes in the file from entries like "-0": the axis of the smallest number runs fastest, '-' runs backwards.
void setLayout(const MrtrixText& text, std::span<const int, 4> axes, std::size_t axis_count, StoredImage& image) {
    const auto entries = splitList(text.only("layout"));
    if (entries.size() != axis_count) {
        throw Error(Code::kCorrupt, text.file() + ": layout names " + std::to_string(entries.size()) + " axes, dim has " +
                                        std::to_string(axis_count));
    }
    std::vector<std::int64_t> position;
    std::vector<bool> reversed;
    for (const std::string_view entry : entries) {
        const bool sign = entry.starts_with('-') || entry.starts_with('+');
        reversed.push_back(entry.starts_with('-'));
        position.push_back(text.integer("layout", sign ? entry.substr(1) : entry));
    }
    std::vector<std::int64_t> sorted = position;
    std::ranges::sort(sorted);
    if (sorted.front() < 0 || std::ranges::adjacent_find(sorted) != sorted.end()) {
        throw Error(Code::kCorrupt, text.file() + ": layout is " + shown(text.only("layout")) +
                                        "; it must give every axis a place of its own, such as +0,+1,+2,+3");
    }
    // Axes that the file lacks or that are dropped have length 1; they may stand anywhere, so they go last.
    std::array<std::int64_t, 4> place{};
    for (std::size_t axis = 0; axis < 4; ++axis) {
        const int from = axes[axis];
        place[axis] = from >= 0 ? position[static_cast<std::size_t>(from)]
                                : std::numeric_limits<std::int64_t>::max() - 4 + static_cast<std::int64_t>(axis);
        image.reversed[axis] = from >= 0 && reversed[static_cast<std::size_t>(from)];
    }
    for (std::size_t axis = 0; axis < 4; ++axis) {
        image.rank[axis] = static_cast<int>(std::ranges::count_if(place, [&](auto other) { return other < place[axis]; }));
    }
}

glm::dmat4 affine(const MrtrixText& text, const StoredImage& image, std::size_t axis_count) {
    const std::vector<double> vox = text.numbers("vox");
    if (vox.size() < std::min<std::size_t>(axis_count, 3)) {
        throw Error(Code::kCorrupt, text.file() + ": vox has " + std::to_string(vox.size()) + " numbers for " +
                                        std::to_string(axis_count) + " axes; there must be one for each");
    }
    glm::dvec3 edge_mm(1.0);
    for (std::size_t axis = 0; axis < std::min<std::size_t>(vox.size(), 3); ++axis) {
        if (!(vox[axis] > 0) || !std::isfinite(vox[axis])) {
            throw Error(Code::kCorrupt, text.file() + ": vox of axis " + std::to_string(axis + 1) + " is " +
                                            std::to_string(vox[axis]) + "; it must be finite and above 0");
        }
        edge_mm[static_cast<int>(axis)] = vox[axis];
    }
    glm::dmat4 matrix(1.0);
    if (!text.has("transform")) {
        for (int axis = 0; axis < 3; ++axis) {
            matrix[axis][axis] = edge_mm[axis];
            matrix[3][axis] = -0.5 * edge_mm[axis] * static_cast<double>(image.size[static_cast<std::size_t>(axis)] - 1);
        }
        return matrix;
    }
    const std::vector<double> rows = text.numbers("transform");
    if (rows.size() != 12 && rows.size() != 16) {
        throw Error(Code::kCorrupt, text.file() + ": transform has " + std::to_string(rows.size()) +
                                        " numbers; it must have 3 rows of 4 (a fourth row is allowed)");
    }
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 4; ++c) matrix[c][r] = rows[static_cast<std::size_t>(4 * r + c)] * (c < 3 ? edge_mm[c] : 1.0);
    }
    return matrix;
}

/// Where the samples are: "file: . OFFSET" in the header's own file, "file: NAME [OFFSET]" in another one.
void setData(const MrtrixText& text, const std::filesystem::path& header_path, StoredImage& image) {
    const std::string entry = text.only("file");
    std::string file = entry;
    std::int64_t offset = 0;
    if (const std::size_t space = entry.find_last_of(" \t"); space != std::string::npos) {
        offset = text.integer("file", std::string_view(entry).substr(space + 1));
        file = entry.substr(0, entry.find_last_not_of(" \t", space) + 1);
    }
    if (offset < 0)
        throw Error(Code::kCorrupt,
                    text.file() + ": the offset in 'file' is " + std::to_string(offset) + "; it must not be negative");
    image.data_offset = static_cast<std::uint64_t>(offset);
    if (file == ".") {
        if (image.data_offset < text.bytes()) {
            throw Error(Code::kCorrupt, text.file() + ": the data begin at byte " + std::to_string(offset) +
                                            ", inside the header of " + std::to_string(text.bytes()) + " bytes");
        }
        image.data_path = header_path;
        return;
    }
    image.data_path = dataFileBeside(header_path, file);
}

/// The keys that this program adds to the format; docs/formats/tensors.md.
std::optional<TensorHeader> tensorHeader(const MrtrixText& text) {
    if (!text.has("tensor_order")) return {};
    TensorHeader header;
    const std::int64_t order = text.integer("tensor_order", text.only("tensor_order"));
    if (order < kTensorOrderMin || order > kTensorOrderMax) {
        throw Error(Code::kUnsupported,
                    text.file() + ": tensor_order is " + std::to_string(order) + "; tensors of order 2 to 12 are read");
    }
    header.order = static_cast<int>(order);
    const std::string components = text.has("tensor_components") ? text.only("tensor_components") : "symmetric";
    if (components != "symmetric" && components != "entries") {
        throw Error(Code::kCorrupt, text.file() + ": tensor_components is " + shown(components) +
                                        "; it must be symmetric (each component once) or entries (all 3^order)");
    }
    if (components == "entries") header.components = TensorFormat::kEntries;
    if (text.has("tensor_trace")) {
        const std::vector<double> trace = text.numbers("tensor_trace");
        if (trace.size() != 1 || !std::isfinite(trace[0])) {
            throw Error(Code::kCorrupt, text.file() + ": tensor_trace is " + shown(text.only("tensor_trace")) +
                                            "; it must be one finite number");
        }
        if (header.order % 2 != 0) {
            throw Error(Code::kCorrupt, text.file() + ": tensor_trace is given for order " + std::to_string(header.order) +
                                            "; only even orders have a full trace");
        }
        header.trace = trace[0];
    }
    return header;
}

}  // namespace

StoredImage readMrtrixHeader(const std::filesystem::path& path) {
    const MrtrixText text(path);
    const std::string& file = text.file();
    std::vector<std::int64_t> dim;
    for (const std::string_view entry : splitList(text.only("dim"))) dim.push_back(text.integer("dim", entry));
    if (dim.empty() || dim.size() > kAxesMax) {
        throw Error(Code::kCorrupt, file + ": dim has " + std::to_string(dim.size()) + " axes; it must have 1 to 16");
    }
    StoredImage image;
    const auto axes = fourAxes(dim, file);
    for (std::size_t axis = 0; axis < 4; ++axis) {
        if (axes[axis] >= 0) image.size[axis] = dim[static_cast<std::size_t>(axes[axis])];
    }
    setLayout(text, axes, dim.size(), image);
    const StoredType stored = sampleType(text);
    image.type = stored.type;
    image.swapped = stored.swapped;
    if (text.has("scaling")) {
        const std::vector<double> scaling = text.numbers("scaling");
        if (scaling.size() != 2 || !std::isfinite(scaling[0]) || !std::isfinite(scaling[1])) {
            throw Error(Code::kCorrupt, file + ": scaling is " + shown(text.only("scaling")) +
                                            "; it must be two finite numbers, offset and scale");
        }
        image.intercept = scaling[0];
        image.slope = scaling[1];
    }
    image.voxel_to_world = affine(text, image, dim.size());
    checkAffine(image.voxel_to_world, file);
    image.tensor = tensorHeader(text);
    setData(text, path, image);
    return image;
}

}  // namespace radiata::io
