// .vtp files put together byte by byte, sharing no code with the readers: every packing, byte order and header.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <zlib.h>

#include "unit/io/image_bytes.h"

namespace radiata::test {

struct VtpFile {
    std::string format = "ascii";  ///< or binary, appended
    bool raw = false, big = false, zlib = false;
    std::string header_type = "UInt32", point_type = "Float32", id_type = "Int32";
    std::size_t block_bytes = 16;
    int pieces = 1;
    std::string head;                        ///< XML before the pieces
    std::vector<double> ids{0, 1, 2, 3, 4};  ///< of lines of 3 and 2 points
};

inline std::string base64(const std::string& bytes) {
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        const std::size_t own = std::min<std::size_t>(bytes.size() - i, 3) + 1;
        for (std::size_t k = 0; k < 4; ++k) text += k < own ? letters[bits >> (18 - 6 * k) & 63U] : '=';
    }
    return text;
}

/// Bytes with the sizes before them, as they stand in a file.
inline std::string vtpPacked(const VtpFile& file, const std::string& bytes) {
    const std::string word = file.header_type == "UInt64" ? "uint64" : "uint32";
    const bool text = !(file.format == "appended" && file.raw);
    if (!file.zlib) {
        const std::string all = encode({static_cast<double>(bytes.size())}, word, file.big) + bytes;
        return text ? base64(all) : all;
    }
    std::vector<double> sizes{0, static_cast<double>(file.block_bytes), static_cast<double>(bytes.size() % file.block_bytes)};
    std::string blocks;
    for (std::size_t at = 0; at < bytes.size(); at += file.block_bytes) {
        const std::string block = bytes.substr(at, file.block_bytes);
        uLongf size = compressBound(block.size());
        std::string packed(size, '\0');
        compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(block.data()), block.size());
        blocks += packed.substr(0, size);
        sizes.push_back(static_cast<double>(size));
        ++sizes[0];
    }
    const std::string header = encode(sizes, word, file.big);
    return text ? base64(header) + base64(blocks) : header + blocks;
}

/// One element of numbers; appended ones go to `appended`.
inline std::string vtpArray(const VtpFile& file, const std::string& name, const std::string& type, int components,
                            const std::vector<double>& numbers, std::string& appended) {
    std::string tag = "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                      std::to_string(components) + "\" format=\"" + file.format + "\"";
    std::string stored = type;
    std::transform(stored.begin(), stored.end(), stored.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (file.format == "appended") {
        tag += " offset=\"" + std::to_string(appended.size()) + "\"/>\n";
        appended += vtpPacked(file, encode(numbers, stored, file.big));
        return tag;
    }
    std::string content;
    if (file.format == "ascii") {
        for (const double number : numbers) {
            std::string digits = std::to_string(number);
            if (stored.find("int") != std::string::npos) digits.resize(digits.find('.'));
            content += digits + "\n";
        }
    } else {
        content = vtpPacked(file, encode(numbers, stored, file.big));
    }
    return tag + ">\n  " + content + "\n</DataArray>\n";
}

/// Two lines through five points in each piece, with a column of each kind: those of vtkText().
inline std::string vtpBytes(const VtpFile& file) {
    std::string appended;
    std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"" +
                      std::string(file.big ? "Big" : "Little") + "Endian\" header_type=\"" + file.header_type + "\"" +
                      (file.zlib ? " compressor=\"vtkZLibDataCompressor\"" : "") + ">\n<PolyData>" + file.head + "\n";
    for (int piece = 0; piece < file.pieces; ++piece) {
        const auto array = [&](const std::string& name, const std::string& type, int components,
                               const std::vector<double>& numbers) {
            return vtpArray(file, name, type, components, numbers, appended);
        };
        xml +=
            "<Piece NumberOfPoints=\"5\" NumberOfVerts=\"1\" NumberOfLines=\"2\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n";
        xml += "<PointData>\n" + array("fa", "Float32", 1, {0.1, 0.2, 0.3, 0.4, 0.5}) + "</PointData>\n";
        xml += "<CellData>\n" + array("id", "UInt16", 2, {9, 9, 1, 2, 3, 4}) + "</CellData>\n";
        xml += "<Points>\n" + array("Points", file.point_type, 3, {1, 2, 3, 1.5, 2, 3, 2, 2, 3, -7, 8, -9, -7, 8.5, -9}) +
               "</Points>\n";
        xml += "<Lines>\n" + array("connectivity", file.id_type, 1, file.ids) + array("offsets", file.id_type, 1, {3, 5}) +
               "</Lines>\n</Piece>\n";
    }
    xml += "</PolyData>\n";
    if (file.format == "appended") {
        xml += "<AppendedData encoding=\"" + std::string(file.raw ? "raw" : "base64") + "\">\n _" + appended +
               "\n</AppendedData>\n";
    }
    return xml + "</VTKFile>\n";
}

}  // namespace radiata::test
