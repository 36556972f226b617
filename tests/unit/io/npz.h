// Reader of NumPy's .npz files (zip of .npy, stored or deflated) for reference values in tests. It trusts its input.
// Formats: numpy.lib.format (NPY 1.0), PKWARE APPNOTE 4.3 (central directory).
#pragma once

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace radiata::test {

/// One array as double, last axis fastest.
struct NpyArray {
    std::vector<std::size_t> shape;
    std::vector<double> values;

    std::size_t rows() const { return shape.at(0); }
    std::size_t rowLength() const { return values.size() / shape.at(0); }
    double at(std::size_t row, std::size_t column) const { return values.at(row * rowLength() + column); }
};

namespace npz_detail {

template <typename Number>
Number number(const std::string& bytes, std::size_t offset) {
    Number value;
    if (offset + sizeof value > bytes.size()) throw std::runtime_error("npz: cut off");
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

template <typename Number>
std::vector<double> numbers(const std::string& bytes, std::size_t offset, std::size_t count) {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = static_cast<double>(number<Number>(bytes, offset + i * sizeof(Number)));
    }
    return values;
}

/// From first axis fastest to last axis fastest.
inline std::vector<double> rowMajor(const std::vector<std::size_t>& shape, const std::vector<double>& columns) {
    std::vector<double> values(columns.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::size_t rest = i, at = 0, stride = values.size();
        for (std::size_t axis = shape.size(); axis-- > 0;) {
            stride /= shape[axis];
            at += rest % shape[axis] * stride;
            rest /= shape[axis];
        }
        values[i] = columns[at];
    }
    return values;
}

inline NpyArray parseNpy(const std::string& bytes) {
    const std::size_t data = 10 + number<std::uint16_t>(bytes, 8);
    const std::string header = bytes.substr(10, data - 10);
    NpyArray array;
    std::size_t count = 1;
    const std::size_t open = header.find('(', header.find("'shape'"));
    std::istringstream shape(header.substr(open + 1, header.find(')', open) - open - 1));
    for (std::string part; std::getline(shape, part, ',');) {
        if (part.find_first_of("0123456789") == std::string::npos) continue;
        array.shape.push_back(std::stoul(part));
        count *= array.shape.back();
    }
    const std::size_t quote = header.find('\'', header.find("'descr'") + 7);
    const std::string type = header.substr(quote + 1, header.find('\'', quote + 1) - quote - 1);
    if (type == "<f8")
        array.values = numbers<double>(bytes, data, count);
    else if (type == "<f4")
        array.values = numbers<float>(bytes, data, count);
    else if (type == "<i4")
        array.values = numbers<std::int32_t>(bytes, data, count);
    else if (type == "<i8")
        array.values = numbers<std::int64_t>(bytes, data, count);
    else if (type == "|i1")
        array.values = numbers<std::int8_t>(bytes, data, count);
    else if (type == "|u1" || type == "|b1")
        array.values = numbers<std::uint8_t>(bytes, data, count);
    else
        throw std::runtime_error("npy: type " + type);
    if (header.find("'fortran_order': True") != std::string::npos) array.values = rowMajor(array.shape, array.values);
    return array;
}

inline std::string inflated(const std::string& packed, std::size_t size) {
    std::string out(size, '\0');
    z_stream stream{};
    if (inflateInit2(&stream, -15) != Z_OK) throw std::runtime_error("inflateInit2");
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(size);
    const int status = inflate(&stream, Z_FINISH);
    inflateEnd(&stream);
    if (status != Z_STREAM_END || stream.total_out != size) throw std::runtime_error("npz: damaged");
    return out;
}

}  // namespace npz_detail

/// All arrays by name (without ".npy"). \throws std::runtime_error
inline std::map<std::string, NpyArray> readNpz(const std::filesystem::path& path) {
    using npz_detail::number;
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    const std::string bytes = text.str();
    const std::size_t end = bytes.rfind(std::string("PK\5\6", 4));
    if (end == std::string::npos) throw std::runtime_error(path.string() + ": no zip file");
    const std::size_t count = number<std::uint16_t>(bytes, end + 10);
    std::size_t entry = number<std::uint32_t>(bytes, end + 16);
    std::map<std::string, NpyArray> arrays;
    for (std::size_t i = 0; i < count; ++i) {
        const int method = number<std::uint16_t>(bytes, entry + 10);
        const std::size_t packed = number<std::uint32_t>(bytes, entry + 20);
        const std::size_t size = number<std::uint32_t>(bytes, entry + 24);
        const std::size_t name_length = number<std::uint16_t>(bytes, entry + 28);
        const std::size_t local = number<std::uint32_t>(bytes, entry + 42);
        const std::string name = bytes.substr(entry + 46, name_length);
        const std::size_t data =
            local + 30 + number<std::uint16_t>(bytes, local + 26) + number<std::uint16_t>(bytes, local + 28);
        const std::string raw = bytes.substr(data, packed);
        arrays[name.substr(0, name.rfind(".npy"))] = npz_detail::parseNpy(method == 8 ? npz_detail::inflated(raw, size) : raw);
        entry += 46 + name_length + number<std::uint16_t>(bytes, entry + 30) + number<std::uint16_t>(bytes, entry + 32);
    }
    return arrays;
}

}  // namespace radiata::test
