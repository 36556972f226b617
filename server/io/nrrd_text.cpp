#include "io/nrrd_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <optional>
#include <span>

#include "base/error.h"
#include "io/byte_source.h"
#include "io/text.h"

namespace radiata::io {
namespace {

constexpr std::size_t kHeaderBytesMax = std::size_t{1} << 20;
constexpr std::size_t kBlockBytes = std::size_t{1} << 14;

/// Index just behind the first empty line, or npos. \param from  where no empty line begins before
std::size_t behindEmptyLine(std::string_view text, std::size_t from) {
    for (std::size_t at = text.find('\n', from); at != std::string_view::npos; at = text.find('\n', at + 1)) {
        std::size_t next = at + 1;
        if (next < text.size() && text[next] == '\r') ++next;
        if (next < text.size() && text[next] == '\n') return next + 1;
    }
    return std::string_view::npos;
}

/// "Space Directions" and "spacedirections" are one field.
std::string fieldName(std::string_view text) {
    std::string name;
    for (const char c : text) {
        if (c != ' ' && c != '\t') name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return name == "centers" ? "centerings" : name;
}

std::optional<double> parsed(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

NrrdText::NrrdText(const std::filesystem::path& path) {
    ByteSource source(path, Packing::kPlain, 0);
    file_ = source.name();
    std::string text;
    std::size_t end = std::string::npos;
    while (end == std::string::npos) {
        const std::size_t before = text.size();
        text.resize(before + kBlockBytes);
        const std::size_t got = source.read(std::as_writable_bytes(std::span(text)).subspan(before));
        text.resize(before + got);
        const bool magic = text.size() > 8 && text.starts_with("NRRD000") && text[7] >= '1' && text[7] <= '5';
        if (!magic) {
            throw Error(Code::kCorrupt, file_ + ": the file begins with " +
                                            shown(text.substr(0, std::min(text.find('\n'), std::size_t{8}))) +
                                            "; a NRRD file begins with NRRD0001 to NRRD0005");
        }
        end = behindEmptyLine(text, before - std::min<std::size_t>(before, 2));
        if (end != std::string::npos) break;
        if (got < kBlockBytes) {
            if (!file_.ends_with(".nhdr")) throw Error(Code::kCorrupt, file_ + ": no empty line ends the header");
            end = text.size();
        } else if (text.size() > kHeaderBytesMax) {
            throw Error(Code::kCorrupt, file_ + ": no empty line ends the header within its first " +
                                            std::to_string(kHeaderBytesMax) + " bytes");
        }
    }
    bytes_ = end;
    parse(std::string_view(text).substr(0, end));
}

void NrrdText::parse(std::string_view text) {
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    while (!text.empty()) {
        const std::size_t length = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, length));
        text.remove_prefix(std::min(length + 1, text.size()));
        if (line.empty() || line.starts_with('#')) continue;
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos) {
            throw Error(Code::kCorrupt, file_ + ": the header has the line " + shown(line) + "; it must be 'field: value'");
        }
        if (line.substr(colon).starts_with(":=")) continue;  // a key of somebody's own
        const std::string name = fieldName(line.substr(0, colon));
        if (!fields_.emplace(name, std::string(trimmed(line.substr(colon + 1)))).second) {
            throw Error(Code::kCorrupt, file_ + ": the header has the field " + shown(line.substr(0, colon)) + " twice");
        }
    }
}

const std::string& NrrdText::value(const std::string& field) const {
    const auto found = fields_.find(field);
    if (found == fields_.end()) throw Error(Code::kCorrupt, file_ + ": the header has no '" + field + "'; it is required");
    return found->second;
}

std::vector<std::string_view> NrrdText::words(const std::string& field) const {
    std::vector<std::string_view> parts;
    std::string_view list = value(field);
    while (true) {
        const std::size_t first = list.find_first_not_of(" \t");
        if (first == std::string_view::npos) return parts;
        const std::size_t end = std::min(list.find_first_of(" \t", first), list.size());
        parts.push_back(list.substr(first, end - first));
        list.remove_prefix(end);
    }
}

std::int64_t NrrdText::integer(const std::string& field, std::string_view text) const {
    std::int64_t value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc() || end != text.data() + text.size()) {
        throw Error(Code::kCorrupt, file_ + ": " + field + " has " + shown(text) + "; it must be a whole number of 64 bits");
    }
    return value;
}

double NrrdText::number(const std::string& field, std::string_view text) const {
    const std::optional<double> value = parsed(text);
    if (!value) throw Error(Code::kCorrupt, file_ + ": " + field + " has " + shown(text) + "; it must be a number");
    return *value;
}

std::vector<glm::dvec3> NrrdText::vectors(const std::string& field) const {
    const auto refuse = [&]() {
        throw Error(Code::kCorrupt, file_ + ": " + field + " is " + shown(value(field)) +
                                        "; it must be vectors of three numbers like (1,0,0), or none");
    };
    std::vector<glm::dvec3> result;
    std::string_view rest = trimmed(value(field));
    while (!rest.empty()) {
        if (rest.starts_with("none")) {
            result.emplace_back(std::numeric_limits<double>::quiet_NaN());
            rest = trimmed(rest.substr(4));
            continue;
        }
        const std::size_t end = rest.find(')');
        if (!rest.starts_with('(') || end == std::string_view::npos) refuse();
        const auto parts = splitList(rest.substr(1, end - 1));
        if (parts.size() != 3) refuse();
        glm::dvec3 vector;
        for (int i = 0; i < 3; ++i) {
            const std::optional<double> part = parsed(parts[static_cast<std::size_t>(i)]);
            if (!part) refuse();
            vector[i] = *part;
        }
        result.push_back(vector);
        rest = trimmed(rest.substr(end + 1));
    }
    return result;
}

}  // namespace radiata::io
