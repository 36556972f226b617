// Reads arrays of a .npz file (a zip of .npy files, stored or deflated) for tests that compare with reference values.
// Header only; a test that includes it links ZLIB::ZLIB. Trusts the file apart from its bounds: it is for our own reference
// data.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <zlib.h>

namespace radiata::testing {

struct NpyArray {
    std::vector<std::size_t> shape;
    std::vector<double> values;  ///< row-major, whatever the type in the file
};

class NpzFile {
public:
    /// \throws std::runtime_error if there is no such file
    explicit NpzFile(const std::filesystem::path& path) : name_(path.string()) {
        std::ifstream file(path, std::ios::binary);
        if (!file) throw std::runtime_error(name_ + ": cannot be read");
        bytes_.assign(std::istreambuf_iterator<char>(file), {});
    }

    /// \throws std::runtime_error if the file has no such array or it has a type other than i1, b1, i4, i8, f4, f8
    NpyArray array(const std::string& name) const {
        const std::size_t end = bytes_.rfind(std::string("PK\5\6", 4));
        if (end == std::string::npos) throw std::runtime_error(name_ + ": not a zip file");
        const auto entries = number<std::uint16_t>(bytes_, end + 10);
        std::size_t at = number<std::uint32_t>(bytes_, end + 16);
        for (std::uint16_t i = 0; i < entries; ++i) {
            const auto name_length = number<std::uint16_t>(bytes_, at + 28);
            if (bytes_.substr(at + 46, name_length) == name + ".npy") return parse(unpack(at));
            at += 46U + name_length + number<std::uint16_t>(bytes_, at + 30) + number<std::uint16_t>(bytes_, at + 32);
        }
        throw std::runtime_error(name_ + ": no array " + name);
    }

private:
    template <typename T>
    static T number(const std::string& bytes, std::size_t at) {
        if (at + sizeof(T) > bytes.size()) throw std::runtime_error("npz: truncated");
        T value;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return value;
    }

    /// The .npy file of a central directory entry.
    std::string unpack(std::size_t entry) const {
        const auto method = number<std::uint16_t>(bytes_, entry + 10);
        const auto packed = number<std::uint32_t>(bytes_, entry + 20);
        const auto size = number<std::uint32_t>(bytes_, entry + 24);
        const std::size_t local = number<std::uint32_t>(bytes_, entry + 42);
        const std::size_t data =
            local + 30 + number<std::uint16_t>(bytes_, local + 26) + number<std::uint16_t>(bytes_, local + 28);
        if (data + packed > bytes_.size()) throw std::runtime_error(name_ + ": truncated");
        if (method == 0) return bytes_.substr(data, size);
        std::string out(size, '\0');
        z_stream stream{};
        inflateInit2(&stream, -MAX_WBITS);
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes_.data() + data));
        stream.avail_in = packed;
        stream.next_out = reinterpret_cast<Bytef*>(out.data());
        stream.avail_out = size;
        const int status = inflate(&stream, Z_FINISH);
        inflateEnd(&stream);
        if (status != Z_STREAM_END) throw std::runtime_error(name_ + ": cannot be inflated");
        return out;
    }

    template <typename T>
    static std::vector<double> convert(const std::string& npy, std::size_t at, std::size_t count) {
        std::vector<double> values(count);
        for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<double>(number<T>(npy, at + i * sizeof(T)));
        return values;
    }

    /// From first axis fastest, as NumPy stores transposed arrays, to last axis fastest.
    static std::vector<double> rowMajor(const NpyArray& columns) {
        std::vector<double> values(columns.values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            std::size_t rest = i, at = 0, stride = values.size();
            for (std::size_t axis = columns.shape.size(); axis-- > 0;) {
                stride /= columns.shape[axis];
                at += rest % columns.shape[axis] * stride;
                rest /= columns.shape[axis];
            }
            values[i] = columns.values[at];
        }
        return values;
    }

    NpyArray parse(const std::string& npy) const {
        const bool first_version = npy.at(6) == 1;
        const std::size_t start = first_version ? 10 : 12;
        const std::size_t length = first_version ? number<std::uint16_t>(npy, 8) : number<std::uint32_t>(npy, 8);
        const std::string header = npy.substr(start, length);
        NpyArray array;
        std::size_t count = 1;
        const std::size_t open = header.find('(');
        for (std::size_t i = open + 1; header.at(i) != ')';) {
            if (header[i] < '0' || header[i] > '9') {
                ++i;
                continue;
            }
            std::size_t digits = 0;
            array.shape.push_back(std::stoul(header.substr(i), &digits));
            count *= array.shape.back();
            i += digits;
        }
        const std::size_t data = start + length;
        if (header.find("<f8") != std::string::npos) {
            array.values = convert<double>(npy, data, count);
        } else if (header.find("<f4") != std::string::npos) {
            array.values = convert<float>(npy, data, count);
        } else if (header.find("<i8") != std::string::npos) {
            array.values = convert<std::int64_t>(npy, data, count);
        } else if (header.find("<i4") != std::string::npos) {
            array.values = convert<std::int32_t>(npy, data, count);
        } else if (header.find("|i1") != std::string::npos || header.find("|b1") != std::string::npos) {
            array.values = convert<std::int8_t>(npy, data, count);
        } else {
            throw std::runtime_error(name_ + ": an array type that is not known: " + header);
        }
        if (header.find("'fortran_order': True") != std::string::npos) array.values = rowMajor(array);
        return array;
    }

    std::string name_;
    std::string bytes_;
};

}  // namespace radiata::testing
