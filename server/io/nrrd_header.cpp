#include "io/nrrd_header.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>

#include "base/error.h"
#include "io/data_file.h"
#include "io/nrrd_text.h"
#include "io/text.h"

namespace radiata::io {
namespace {

constexpr std::int64_t kAxesMax = 16;

SampleType sampleType(const NrrdText& text) {
    using Names = std::array<std::string_view, 8>;
    static constexpr std::array<std::pair<SampleType, Names>, 10> kTypes{{
        {SampleType::kInt8, {"signed char", "int8", "int8_t"}},
        {SampleType::kUInt8, {"uchar", "unsigned char", "uint8", "uint8_t"}},
        {SampleType::kInt16, {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}},
        {SampleType::kUInt16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
        {SampleType::kInt32, {"int", "signed int", "int32", "int32_t"}},
        {SampleType::kUInt32, {"uint", "unsigned int", "uint32", "uint32_t"}},
        {SampleType::kInt64,
         {"longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t"}},
        {SampleType::kUInt64, {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"}},
        {SampleType::kFloat32, {"float"}},
        {SampleType::kFloat64, {"double"}},
    }};
    const std::string& written = text.value("type");
    for (const auto& [type, names] : kTypes) {
        if (!written.empty() && std::ranges::find(names, written) != names.end()) return type;
    }
    throw Error(Code::kUnsupported, text.file() + ": type is " + shown(written) +
                                        "; the format's integers of 8 to 64 bits, float and double are read");
}

bool isSwapped(const NrrdText& text, SampleType type) {
    if (bitsOf(type) <= 8) return false;
    const std::string& endian = text.value("endian");
    if (endian != "little" && endian != "big") {
        throw Error(Code::kCorrupt, text.file() + ": endian is " + shown(endian) + "; it must be little or big");
    }
    return (endian == "big") != (std::endian::native == std::endian::big);
}

/// Directions of the axes as the file has them; NaN where an axis is none of space.
std::vector<glm::dvec3> directions(const NrrdText& text, std::size_t axis_count) {
    std::vector<glm::dvec3> result;
    if (text.has("spacedirections")) {
        result = text.vectors("spacedirections");
        if (result.size() != axis_count) {
            throw Error(Code::kCorrupt, text.file() + ": 'space directions' has " + std::to_string(result.size()) +
                                            " entries for " + std::to_string(axis_count) + " axes; there must be one for each");
        }
        return result;
    }
    std::vector<double> spacings(axis_count, 1.0);
    if (text.has("spacings")) {
        const auto words = text.words("spacings");
        if (words.size() != axis_count) {
            throw Error(Code::kCorrupt, text.file() + ": spacings has " + std::to_string(words.size()) + " numbers for " +
                                            std::to_string(axis_count) + " axes; there must be one for each");
        }
        for (std::size_t axis = 0; axis < axis_count; ++axis) spacings[axis] = text.number("spacings", words[axis]);
    }
    for (std::size_t axis = 0; axis < axis_count; ++axis) {
        glm::dvec3 direction(0);
        // NaN is the format's word for an axis without a spacing.
        if (axis < 3) direction[static_cast<int>(axis)] = std::isnan(spacings[axis]) ? 1.0 : spacings[axis];
        result.push_back(axis < 3 ? direction : glm::dvec3(std::nan("")));
    }
    return result;
}

/// What the space's axes have to be multiplied by to become right, anterior, superior.
glm::dvec3 towardsRas(const NrrdText& text) {
    if (!text.has("space")) return glm::dvec3(1);
    std::string space = text.value("space");
    std::ranges::transform(space, space.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (space.ends_with("-time") || space == "rast" || space == "last" || space == "lpst") {
        throw Error(Code::kUnsupported,
                    text.file() + ": space is " + shown(text.value("space")) + "; volumes without time are read");
    }
    if (space == "left-anterior-superior" || space == "las") return {-1, 1, 1};
    if (space == "left-posterior-superior" || space == "lps") return {-1, -1, 1};
    return glm::dvec3(1);
}

glm::dmat4 affine(const NrrdText& text, const std::vector<glm::dvec3>& axes) {
    glm::dmat4 matrix(1.0);
    const glm::dvec3 flip = towardsRas(text);
    for (int axis = 0; axis < 3; ++axis) {
        matrix[axis] = glm::dvec4(flip * axes[static_cast<std::size_t>(axis)], 0);
    }
    if (text.has("spaceorigin")) {
        const auto origin = text.vectors("spaceorigin");
        if (origin.size() != 1) {
            throw Error(Code::kCorrupt, text.file() + ": 'space origin' is " + shown(text.value("spaceorigin")) +
                                            "; it must be one vector of three numbers");
        }
        matrix[3] = glm::dvec4(flip * origin[0], 1);
    }
    return matrix;
}

std::int64_t skip(const NrrdText& text, const std::string& field) {
    return text.has(field) ? text.integer(field, text.value(field)) : 0;
}

void setData(const NrrdText& text, const std::filesystem::path& header_path, StoredImage& image) {
    const std::string& encoding = text.value("encoding");
    if (encoding == "raw") {
        image.packing = Packing::kPlain;
    } else if (encoding == "gzip" || encoding == "gz") {
        image.packing = Packing::kGzip;
    } else {
        throw Error(Code::kUnsupported, text.file() + ": encoding is " + shown(encoding) +
                                            "; raw and gzip are read (unu save -f nrrd -e gzip makes it)");
    }
    const std::string field = text.has("datafile") ? "datafile" : "";
    if (field.empty()) {
        if (header_path.extension() == ".nhdr") {
            throw Error(Code::kCorrupt, text.file() + ": the header names no 'data file'; a .nhdr file has its data elsewhere");
        }
        image.data_path = header_path;
        image.packed_offset = text.bytes();
    } else {
        const std::string& name = text.value(field);
        if (name.starts_with("LIST") || name.find('%') != std::string::npos) {
            throw Error(Code::kUnsupported,
                        text.file() + ": the data are spread over files (" + shown(name) + "); one data file is read");
        }
        image.data_path = dataFileBeside(header_path, name);
    }
    if (skip(text, "lineskip") != 0) {
        throw Error(Code::kUnsupported, text.file() + ": 'line skip' is " + shown(text.value("lineskip")) +
                                            "; data without lines before them are read, use 'byte skip'");
    }
    const std::int64_t bytes = skip(text, "byteskip");
    if (bytes == -1 && image.packing == Packing::kPlain) {
        // The samples are the file's last bytes.
        const std::uint64_t file_bytes = std::filesystem::file_size(image.data_path);
        std::uint64_t samples = bitsOf(image.type) / 8;
        for (const std::int64_t length : image.size)
            samples *= static_cast<std::uint64_t>(length);  // fourAxes() has checked it
        if (samples > file_bytes) {
            throw Error(Code::kCorrupt, text.file() + ": the header promises " + std::to_string(samples) +
                                            " bytes of samples, the file has " + std::to_string(file_bytes));
        }
        image.packed_offset = file_bytes - samples;
        return;
    }
    if (bytes < 0) {
        throw Error(Code::kCorrupt, text.file() + ": 'byte skip' is " + std::to_string(bytes) +
                                        "; it must be 0 or more, or -1 for raw data at the file's end");
    }
    image.data_offset = static_cast<std::uint64_t>(bytes);
}

}  // namespace

StoredImage readNrrdHeader(const std::filesystem::path& path) {
    const NrrdText text(path);
    const std::string& file = text.file();
    const std::int64_t dimension = text.integer("dimension", text.value("dimension"));
    if (dimension < 1 || dimension > kAxesMax) {
        throw Error(Code::kCorrupt, file + ": dimension is " + std::to_string(dimension) + "; it must be 1 to 16");
    }
    std::vector<std::int64_t> sizes;
    for (const std::string_view word : text.words("sizes")) sizes.push_back(text.integer("sizes", word));
    if (sizes.size() != static_cast<std::size_t>(dimension)) {
        throw Error(Code::kCorrupt, file + ": sizes has " + std::to_string(sizes.size()) + " numbers, dimension is " +
                                        std::to_string(dimension));
    }
    if (text.has("spacedimension") && text.integer("spacedimension", text.value("spacedimension")) != 3) {
        throw Error(Code::kUnsupported, file + ": 'space dimension' is " + shown(text.value("spacedimension")) + "; 3 is read");
    }
    fourAxes(sizes, file);  // lengths and their product
    // Axes of space first, in their order; others have length 1 and so change nothing about the samples' order.
    const std::vector<glm::dvec3> all = directions(text, sizes.size());
    StoredImage image;
    std::vector<glm::dvec3> axes;
    for (std::size_t axis = 0; axis < sizes.size(); ++axis) {
        const bool space = !std::isnan(all[axis].x) && axes.size() < 3;
        if (space) {
            image.size[axes.size()] = sizes[axis];
            axes.push_back(all[axis]);
        } else if (sizes[axis] > 1) {
            throw Error(Code::kUnsupported,
                        file + ": axis " + std::to_string(axis + 1) + " has " + std::to_string(sizes[axis]) +
                            " entries and is none of the three of space; volumes of one number per voxel are read");
        }
    }
    if (axes.empty()) throw Error(Code::kCorrupt, file + ": no axis is one of space");
    // A file of fewer axes has one slice, or row; what the missing ones are does not matter, as long as they span a volume.
    for (int unit = 0; axes.size() < 3 && unit < 3; ++unit) {
        glm::dvec3 e(0);
        e[unit] = 1;
        const glm::dvec3 candidate = axes.size() == 2 ? glm::cross(axes[0], axes[1]) : glm::cross(axes[0], e);
        if (glm::length(candidate) > 1e-6) axes.push_back(glm::normalize(candidate));
    }
    if (axes.size() < 3) throw Error(Code::kCorrupt, file + ": the space directions span no volume");
    image.voxel_to_world = affine(text, axes);
    checkAffine(image.voxel_to_world, file);
    image.type = sampleType(text);
    image.swapped = isSwapped(text, image.type);
    setData(text, path, image);
    return image;
}

}  // namespace radiata::io
