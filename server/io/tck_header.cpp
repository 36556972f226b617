#include "io/tck_header.h"

#include <bit>
#include <charconv>

#include "base/error.h"
#include "io/text.h"

namespace radiata::io {
namespace {

constexpr std::size_t kHeaderMax = std::size_t{1} << 24;

std::optional<std::uint64_t> whole(std::string_view text) {
    std::uint64_t value = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// One line without its end; nothing at the end of the file.
std::optional<std::string> nextLine(ByteSource& source) {
    std::string line;
    std::byte next{};
    while (source.read({&next, 1}) == 1) {
        if (next == std::byte{'\n'}) return line;
        line += static_cast<char>(next);
        if (source.position() > kHeaderMax) {
            throw Error(Code::kCorrupt, source.name() + ": its text header does not end within " + std::to_string(kHeaderMax) +
                                            " bytes; the line END is missing");
        }
    }
    if (line.empty()) return std::nullopt;
    return line;
}

void setType(TckHeader& header, std::string_view type, const std::string& name) {
    const bool big = type.ends_with("BE"), little = type.ends_with("LE");
    const std::string_view stem = big || little ? type.substr(0, type.size() - 2) : type;
    if (stem == "Float32") {
        header.type = SampleType::kFloat32;
    } else if (stem == "Float64") {
        header.type = SampleType::kFloat64;
    } else {
        throw Error(Code::kUnsupported, name + ": the header line 'datatype' says " + shown(type) +
                                            "; Float32LE, Float32BE, Float64LE and Float64BE are read");
    }
    const bool native_big = std::endian::native == std::endian::big;
    header.swapped = (big && !native_big) || (little && native_big);
}

std::uint64_t dataOffset(std::string_view value, const std::string& name) {
    const std::size_t blank = value.find_last_of(" \t");
    if (blank == value.npos || trimmed(value.substr(0, blank)) != ".") {
        throw Error(Code::kUnsupported, name + ": the header line 'file' says " + shown(value) +
                                            "; it must be '. OFFSET', data in another file are not read");
    }
    const auto offset = whole(value.substr(blank + 1));
    if (!offset)
        throw Error(Code::kCorrupt, name + ": the header line 'file' says " + shown(value) + ", which names no offset");
    return *offset;
}

}  // namespace

TckHeader readTckHeader(ByteSource& source, const std::string& magic) {
    TckHeader header;
    const std::string name = source.name();
    const std::string first = nextLine(source).value_or("");
    if (trimmed(first) != magic) {
        throw Error(Code::kCorrupt, name + ": the first line is " + shown(first) + ", not '" + magic + "'");
    }
    bool typed = false;
    std::optional<std::uint64_t> offset;
    for (;;) {
        const std::optional<std::string> line = nextLine(source);
        if (!line) throw Error(Code::kCorrupt, name + ": the file ends within its text header, before the line END");
        const std::string_view text = trimmed(*line);
        if (text == "END") break;
        const std::size_t colon = text.find(':');
        if (colon == text.npos) continue;  // the rest of a value over several lines
        const std::string_view key = trimmed(text.substr(0, colon)), value = trimmed(text.substr(colon + 1));
        if (key == "datatype") {
            setType(header, value, name);
            typed = true;
        } else if (key == "file") {
            offset = dataOffset(value, name);
        } else if (key == "count") {
            header.count = whole(value);
        }
    }
    if (!typed) header.remarks += "The header names no datatype; Float32LE is assumed. ";
    if (!offset) header.remarks += "The header does not say where the data begin; right after END is assumed. ";
    header.data_begin = offset.value_or(source.position());
    if (header.data_begin < source.position()) {
        throw Error(Code::kCorrupt, name + ": the header line 'file' places the data at byte " +
                                        std::to_string(header.data_begin) + ", inside the header of " +
                                        std::to_string(source.position()) + " bytes");
    }
    return header;
}

}  // namespace radiata::io
