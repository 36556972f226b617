// What a .trx file says about itself, held against the sizes of its arrays, and its groups.
#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/checked.h"
#include "base/error.h"
#include "io/text.h"
#include "io/trx.h"

namespace radiata::io {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are taken as they stand");
constexpr std::uint64_t kJsonMax = std::uint64_t{1} << 20;
constexpr std::uint64_t kRatioMax = 100, kRatioFromBytes = std::uint64_t{1} << 26;

std::optional<SampleType> typeNamed(const std::string& name) {
    static const std::map<std::string, SampleType> kTypes{
        {"int8", SampleType::kInt8},       {"uint8", SampleType::kUInt8},     {"int16", SampleType::kInt16},
        {"uint16", SampleType::kUInt16},   {"int32", SampleType::kInt32},     {"uint32", SampleType::kUInt32},
        {"int64", SampleType::kInt64},     {"uint64", SampleType::kUInt64},   {"float16", SampleType::kFloat16},
        {"float32", SampleType::kFloat32}, {"float64", SampleType::kFloat64},
    };
    const auto found = kTypes.find(name);
    if (found == kTypes.end()) return std::nullopt;
    return found->second;
}

/// "folder/name.3.float32"; nothing if the name has no number type at its end.
std::optional<TrxArray> parse(const std::string& entry) {
    TrxArray array;
    array.entry = entry;
    std::string file = entry.substr(entry.rfind('/') + 1);
    const std::size_t dot = file.rfind('.');
    if (dot == file.npos || dot == 0) return std::nullopt;
    const std::optional<SampleType> type = typeNamed(file.substr(dot + 1));
    if (!type) return std::nullopt;
    array.type = *type;
    file.resize(dot);
    const std::size_t second = file.rfind('.');
    const bool counted = second != file.npos && second > 0 && second + 1 < file.size() && file.size() - second < 8 &&
                         file.find_first_not_of("0123456789", second + 1) == file.npos;
    if (counted) {
        array.components = std::stoull(file.substr(second + 1));
        file.resize(second);
    }
    array.name = file;
    return array;
}

std::uint64_t bytesEach(const TrxArray& array) {
    return checkedMultiply(array.components, bitsOf(array.type) / 8, array.entry);
}

void requireSize(const TrxFiles& files, const TrxArray& array, std::uint64_t count, const char* of) {
    const std::uint64_t wanted = checkedMultiply(count, bytesEach(array), array.entry);
    const std::uint64_t bytes = files.entries().at(array.entry).bytes;
    if (bytes == wanted) return;
    throw Error(Code::kCorrupt, files.name() + "/" + array.entry + ": has " + std::to_string(bytes) + " bytes; " +
                                    std::to_string(count) + " " + of + " need " + std::to_string(wanted));
}

/// A little file must not stand for a lot of memory: coordinates hardly compress.
void requireNoBomb(const TrxFiles& files, const std::string& entry) {
    const TrxFiles::Entry& found = files.entries().at(entry);
    if (found.bytes <= kRatioFromBytes || found.bytes / kRatioMax <= found.stored) return;
    throw Error(Code::kResourceExhausted, files.name() + "/" + entry + ": " + std::to_string(found.stored) +
                                              " compressed bytes claim to hold " + std::to_string(found.bytes) +
                                              "; coordinates do not compress over " + std::to_string(kRatioMax) + " to 1");
}

std::uint64_t countIn(const nlohmann::json& json, const char* key, const std::string& file) {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_number_integer() ||
        (!found->is_number_unsigned() && found->get<std::int64_t>() < 0)) {
        throw Error(Code::kCorrupt, file + "/header.json: " + key + " is missing or is no whole number of 0 or more");
    }
    return found->get<std::uint64_t>();
}

void readGrid(const nlohmann::json& json, model::TractogramHeader& header) {
    const auto size = json.find("DIMENSIONS");
    const auto matrix = json.find("VOXEL_TO_RASMM");
    if (size != json.end() && size->is_array() && size->size() == 3) {
        for (int i = 0; i < 3; ++i) {
            const nlohmann::json& length = (*size)[static_cast<std::size_t>(i)];
            if (length.is_number()) header.grid_size[i] = static_cast<int>(std::clamp(length.get<double>(), 0.0, 1e6));
        }
    }
    if (matrix == json.end() || !matrix->is_array() || matrix->size() != 4) return;
    glm::dmat4 read(1.0);
    for (int r = 0; r < 4; ++r) {
        const nlohmann::json& row = (*matrix)[static_cast<std::size_t>(r)];
        if (!row.is_array() || row.size() != 4) return;
        for (int c = 0; c < 4; ++c) {
            const nlohmann::json& number = row[static_cast<std::size_t>(c)];
            if (!number.is_number() || !std::isfinite(number.get<double>())) return;
            read[c][r] = number.get<double>();
        }
    }
    header.voxel_to_world = read;
}

void readJson(const TrxFiles& files, TrxHeader& header) {
    if (!files.entries().contains("header.json")) {
        throw Error(Code::kCorrupt, files.name() + ": has no header.json; it is no TRX tractogram");
    }
    const nlohmann::json json = nlohmann::json::parse(files.readAll("header.json", kJsonMax), nullptr, false);
    if (!json.is_object()) throw Error(Code::kCorrupt, files.name() + "/header.json: is no JSON object");
    header.fibres = countIn(json, "NB_STREAMLINES", files.name());
    header.points = countIn(json, "NB_VERTICES", files.name());
    if (header.fibres > model::kFibreCountMax) {
        throw Error(Code::kResourceExhausted, files.name() + ": holds " + std::to_string(header.fibres) + " fibres; at most " +
                                                  std::to_string(model::kFibreCountMax) + " can be numbered with 32 bits");
    }
    readGrid(json, header.tractogram);
}

void addColumn(std::vector<TrxArray>& arrays, std::vector<model::ColumnName>& columns, const TrxArray& array,
               const std::string& file) {
    if (array.components == 0 || array.components > 4096) {
        throw Error(Code::kUnsupported, file + "/" + array.entry + ": has " + std::to_string(array.components) +
                                            " numbers each; 1 to 4096 are read");
    }
    for (const TrxArray& other : arrays) {
        if (other.name == array.name) {
            throw Error(Code::kCorrupt, file + ": has two columns " + shown(array.name) + " in one folder");
        }
    }
    arrays.push_back(array);
    columns.push_back({array.name, static_cast<int>(array.components)});
}

void checkArrays(const TrxFiles& files, TrxHeader& header) {
    const bool empty = header.fibres == 0 && header.points == 0;
    if (header.positions.entry.empty() || header.offsets.entry.empty()) {
        if (empty) return;
        throw Error(Code::kCorrupt, files.name() + ": has no " +
                                        (header.positions.entry.empty() ? "positions.3.float16, float32 or float64"
                                                                        : "offsets.uint32 or uint64") +
                                        " array, and " + std::to_string(header.fibres) + " streamlines");
    }
    requireNoBomb(files, header.positions.entry);
    requireNoBomb(files, header.offsets.entry);
    requireSize(files, header.positions, header.points, "vertices");
    const std::uint64_t bytes = files.entries().at(header.offsets.entry).bytes, each = bytesEach(header.offsets);
    if (bytes != header.fibres * each) requireSize(files, header.offsets, header.fibres + 1, "offsets");
    for (const TrxArray& array : header.vertex) requireSize(files, array, header.points, "vertices");
    for (const TrxArray& array : header.fibre) requireSize(files, array, header.fibres, "streamlines");
}

}  // namespace

TrxHeader readTrxHeader(const TrxFiles& files) {
    TrxHeader header;
    header.tractogram.source = files.name();
    header.tractogram.format = "trx";
    readJson(files, header);
    header.tractogram.fibre_count = header.fibres;
    header.tractogram.point_count = header.points;
    for (const auto& [entry, unused] : files.entries()) {
        const std::optional<TrxArray> array = parse(entry);
        if (!array) {
            if (entry != "header.json") header.tractogram.remarks += "Left out: " + shown(entry) + ", no array of numbers. ";
        } else if (entry.starts_with("positions.") && array->components == 3) {
            header.positions = *array;
        } else if (entry.starts_with("offsets.")) {
            header.offsets = *array;
        } else if (entry.starts_with("dpv/")) {
            addColumn(header.vertex, header.tractogram.vertex_columns, *array, files.name());
        } else if (entry.starts_with("dps/")) {
            addColumn(header.fibre, header.tractogram.fibre_columns, *array, files.name());
        } else if (entry.starts_with("groups/")) {
            header.groups.push_back(*array);
        }
    }
    checkArrays(files, header);
    return header;
}

std::vector<model::FibreGroup> readTrxGroups(const TrxFiles& files, const TrxHeader& header) {
    std::vector<model::FibreGroup> groups;
    for (const TrxArray& array : header.groups) {
        const std::uint64_t bytes = files.entries().at(array.entry).bytes;
        if (array.type != SampleType::kUInt32 || bytes % 4 != 0) {
            throw Error(Code::kUnsupported, files.name() + "/" + array.entry + ": groups are lists of uint32; this one is not");
        }
        if (bytes / 4 > header.fibres) {
            throw Error(Code::kCorrupt, files.name() + "/" + array.entry + ": lists " + std::to_string(bytes / 4) + " of " +
                                            std::to_string(header.fibres) + " streamlines");
        }
        model::FibreGroup group;
        group.name = array.name;
        group.fibres.resize(bytes / 4);
        if (bytes > 0) files.open(array.entry)->read(std::as_writable_bytes(std::span(group.fibres)));
        std::sort(group.fibres.begin(), group.fibres.end());
        group.fibres.erase(std::unique(group.fibres.begin(), group.fibres.end()), group.fibres.end());
        if (!group.fibres.empty() && group.fibres.back() >= header.fibres) {
            throw Error(Code::kCorrupt, files.name() + "/" + array.entry + ": names streamline " +
                                            std::to_string(group.fibres.back()) + "; there are " +
                                            std::to_string(header.fibres) + ", counted from 0");
        }
        const std::string prefix = "dpg/" + group.name + "/";
        for (auto at = files.entries().lower_bound(prefix); at != files.entries().end() && at->first.starts_with(prefix);
             ++at) {
            const std::optional<TrxArray> value = parse(at->first);
            if (!value || value->components > 4096) continue;
            requireSize(files, *value, 1, "groups");
            std::string stored = files.readAll(at->first, 1U << 20);
            group.columns.push_back({value->name, static_cast<int>(value->components)});
            group.values.emplace_back(value->components);
            decodeSamples(value->type, false, 1, 0, std::as_bytes(std::span(stored)), group.values.back());
        }
        groups.push_back(std::move(group));
    }
    return groups;
}

}  // namespace radiata::io
