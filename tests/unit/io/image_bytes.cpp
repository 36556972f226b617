#include "unit/io/image_bytes.h"

#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace radiata::test {
namespace {

/// A number of `size` bytes put at an offset in the wanted byte order (this machine's is little-endian).
template <typename Number>
void put(std::string& bytes, std::size_t offset, Number value, bool big_endian) {
    std::string raw(sizeof value, '\0');
    std::memcpy(raw.data(), &value, sizeof value);
    if (big_endian) std::reverse(raw.begin(), raw.end());
    bytes.replace(offset, raw.size(), raw);
}

template <typename Number>
std::string encodeAs(const std::vector<double>& values, bool big_endian) {
    std::string bytes(values.size() * sizeof(Number), '\0');
    for (std::size_t i = 0; i < values.size(); ++i) put(bytes, i * sizeof(Number), static_cast<Number>(values[i]), big_endian);
    return bytes;
}

std::string nifti1(const NiftiFile& file) {
    std::string out(352, '\0');
    const bool big = file.big_endian;
    put<std::int32_t>(out, 0, 348, big);
    put<std::int16_t>(out, 40, static_cast<std::int16_t>(file.dim0 >= 0 ? file.dim0 : static_cast<int>(file.dim.size())), big);
    for (std::size_t i = 0; i < 7; ++i) {
        const std::int64_t length = i < file.dim.size() ? file.dim[i] : 1;
        put<std::int16_t>(out, 42 + 2 * i, static_cast<std::int16_t>(length), big);
    }
    put<std::int16_t>(out, 70, static_cast<std::int16_t>(file.datatype), big);
    put<std::int16_t>(out, 72, static_cast<std::int16_t>(file.bitpix), big);
    for (std::size_t i = 0; i < 8; ++i) put<float>(out, 76 + 4 * i, static_cast<float>(file.pixdim[i]), big);
    put<float>(out, 108, static_cast<float>(file.vox_offset == -1 ? 352 : file.vox_offset), big);
    put<float>(out, 112, static_cast<float>(file.slope), big);
    put<float>(out, 116, static_cast<float>(file.intercept), big);
    put<std::int16_t>(out, 252, static_cast<std::int16_t>(file.qform_code), big);
    put<std::int16_t>(out, 254, static_cast<std::int16_t>(file.sform_code), big);
    for (std::size_t i = 0; i < 6; ++i) put<float>(out, 256 + 4 * i, static_cast<float>(file.quatern[i]), big);
    for (std::size_t i = 0; i < 12; ++i) put<float>(out, 280 + 4 * i, static_cast<float>(file.srow[i]), big);
    const std::string magic = file.magic.empty() ? std::string("n+1\0", 4) : file.magic;
    out.replace(344, 4, magic);
    return out + file.data;
}

std::string nifti2(const NiftiFile& file) {
    std::string out(544, '\0');
    const bool big = file.big_endian;
    put<std::int32_t>(out, 0, 540, big);
    out.replace(4, 8, file.magic.empty() ? std::string("n+2\0\r\n\032\n", 8) : file.magic);
    put<std::int16_t>(out, 12, static_cast<std::int16_t>(file.datatype), big);
    put<std::int16_t>(out, 14, static_cast<std::int16_t>(file.bitpix), big);
    put<std::int64_t>(out, 16, file.dim0 >= 0 ? file.dim0 : static_cast<std::int64_t>(file.dim.size()), big);
    for (std::size_t i = 0; i < 7; ++i) put<std::int64_t>(out, 24 + 8 * i, i < file.dim.size() ? file.dim[i] : 1, big);
    for (std::size_t i = 0; i < 8; ++i) put<double>(out, 104 + 8 * i, file.pixdim[i], big);
    put<std::int64_t>(out, 168, file.vox_offset == -1 ? 544 : static_cast<std::int64_t>(file.vox_offset), big);
    put<double>(out, 176, file.slope, big);
    put<double>(out, 184, file.intercept, big);
    put<std::int32_t>(out, 344, file.qform_code, big);
    put<std::int32_t>(out, 348, file.sform_code, big);
    for (std::size_t i = 0; i < 6; ++i) put<double>(out, 352 + 8 * i, file.quatern[i], big);
    for (std::size_t i = 0; i < 12; ++i) put<double>(out, 400 + 8 * i, file.srow[i], big);
    return out + file.data;
}

std::string headerText(const MrtrixFile& file) {
    std::string text = file.first_line + "\n";
    for (const auto& [key, value] : file.lines) text += key + ": " + value + "\n";
    return text;
}

}  // namespace

TempFolder::TempFolder() {
    static std::atomic<int> counter{0};
    // In memory where there is such a folder: the tests write thousands of small files.
    const std::filesystem::path memory = "/dev/shm";
    path_ = (::access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path()) /
            ("radiata_test_" + std::to_string(::getpid()) + "_" + std::to_string(counter++));
    std::filesystem::create_directories(path_);
}

TempFolder::~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TempFolder::write(const std::string& name, std::string_view bytes) const {
    const std::filesystem::path path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path;
}

std::string encode(const std::vector<double>& values, const std::string& type, bool big_endian) {
    if (type == "int8") return encodeAs<std::int8_t>(values, big_endian);
    if (type == "uint8") return encodeAs<std::uint8_t>(values, big_endian);
    if (type == "int16") return encodeAs<std::int16_t>(values, big_endian);
    if (type == "uint16") return encodeAs<std::uint16_t>(values, big_endian);
    if (type == "int32") return encodeAs<std::int32_t>(values, big_endian);
    if (type == "uint32") return encodeAs<std::uint32_t>(values, big_endian);
    if (type == "int64") return encodeAs<std::int64_t>(values, big_endian);
    if (type == "uint64") return encodeAs<std::uint64_t>(values, big_endian);
    if (type == "float32") return encodeAs<float>(values, big_endian);
    if (type == "float64") return encodeAs<double>(values, big_endian);
    if (type == "float128") return encodeAs<__float128>(values, big_endian);
    if (type != "bit") throw std::invalid_argument("encode: " + type);
    std::string bytes((values.size() + 7) / 8, '\0');
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] != 0) bytes[i / 8] = static_cast<char>(bytes[i / 8] | (128 >> (i % 8)));
    }
    return bytes;
}

int niftiDatatype(const std::string& type) {
    static const std::vector<std::pair<std::string, int>> kTypes{
        {"uint8", 2},    {"int16", 4},    {"int32", 8},    {"float32", 16},  {"float64", 64},   {"int8", 256},
        {"uint16", 512}, {"uint32", 768}, {"int64", 1024}, {"uint64", 1280}, {"float128", 1536}};
    for (const auto& [name, number] : kTypes) {
        if (name == type) return number;
    }
    return 0;
}

std::string gzip(std::string_view bytes) {
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK) throw std::runtime_error("deflateInit2");
    std::string out(deflateBound(&stream, bytes.size()) + 64, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    const int status = deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    if (status != Z_STREAM_END) throw std::runtime_error("deflate");
    return out;
}

std::string bytes(const NiftiFile& file) { return file.version == 1 ? nifti1(file) : nifti2(file); }

MrtrixFile mrtrixFile(const std::vector<std::int64_t>& dim, const std::string& layout, const std::string& datatype) {
    MrtrixFile file;
    std::string lengths, edges;
    for (std::size_t i = 0; i < dim.size(); ++i) {
        lengths += (i ? "," : "") + std::to_string(dim[i]);
        edges += i ? (i < 3 ? ",1" : ",nan") : "1";
    }
    file.lines = {{"dim", lengths},         {"vox", edges},           {"layout", layout},      {"datatype", datatype},
                  {"transform", "1,0,0,0"}, {"transform", "0,1,0,0"}, {"transform", "0,0,1,0"}};
    return file;
}

void set(MrtrixFile& file, const std::string& key, const std::string& value) {
    std::erase_if(file.lines, [&](const auto& line) { return line.first == key; });
    if (!value.empty()) file.lines.emplace_back(key, value);
}

std::string mifBytes(const MrtrixFile& file) {
    const std::string text = headerText(file);
    // The offset is part of the header whose length it depends on: make room for it.
    std::string offset = std::to_string((text.size() + 64) / 16 * 16);
    std::string header = text + "file: . " + offset + "\nEND\n";
    header.resize(std::stoul(offset), '\0');
    return header + file.data;
}

std::string mihText(const MrtrixFile& file, const std::string& data_entry) {
    return headerText(file) + "file: " + data_entry + "\nEND\n";
}

std::vector<double> inLayout(const std::array<std::int64_t, 4>& dim, const std::string& layout,
                             const std::function<double(std::int64_t, std::int64_t, std::int64_t, std::int64_t)>& value) {
    std::array<std::size_t, 4> axis_of_rank{};
    std::array<bool, 4> backwards{};
    std::istringstream entries(layout);
    for (std::size_t axis = 0; axis < 4; ++axis) {
        std::string entry;
        std::getline(entries, entry, ',');
        backwards[axis] = entry.at(0) == '-';
        axis_of_rank.at(static_cast<std::size_t>(entry.at(1) - '0')) = axis;
    }
    std::vector<double> values;
    std::array<std::int64_t, 4> at{};
    const std::int64_t count = dim[0] * dim[1] * dim[2] * dim[3];
    for (std::int64_t n = 0; n < count; ++n) {
        std::int64_t rest = n;
        for (const std::size_t axis : axis_of_rank) {
            const std::int64_t step = rest % dim[axis];
            rest /= dim[axis];
            at[axis] = backwards[axis] ? dim[axis] - 1 - step : step;
        }
        values.push_back(value(at[0], at[1], at[2], at[3]));
    }
    return values;
}

}  // namespace radiata::test
