#include "io/mrtrix_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "base/error.h"
#include "io/byte_source.h"
#include "io/text.h"

namespace radiata::io {
namespace {

constexpr std::size_t kHeaderBytesMax = std::size_t{16} << 20;
constexpr std::size_t kBlockBytes = std::size_t{1} << 16;

/// Index just behind the line "END", or npos; looks only at [from, end).
std::size_t behindEnd(std::string_view text, std::size_t from) {
    for (std::size_t at = text.find("\nEND", from); at != std::string_view::npos; at = text.find("\nEND", at + 1)) {
        const std::size_t after = text.find_first_not_of(kBlanks, at + 4);
        if (after != std::string_view::npos && text[after] == '\n') return after + 1;
    }
    return std::string_view::npos;
}

}  // namespace

MrtrixText::MrtrixText(const std::filesystem::path& path) {
    ByteSource source(path);
    file_ = source.name();
    const bool alone = file_.ends_with(".mih");
    std::string text;
    std::size_t end = std::string::npos;
    while (end == std::string::npos) {
        const std::size_t before = text.size();
        text.resize(before + kBlockBytes);
        const std::size_t got = source.read(std::as_writable_bytes(std::span(text)).subspan(before));
        text.resize(before + got);
        if (!text.starts_with("mrtrix image")) {
            throw Error(Code::kCorrupt, file_ + ": the first line is " + shown(text.substr(0, text.find('\n'))) +
                                            "; an MRtrix image begins with 'mrtrix image'");
        }
        // Look again at the last bytes of the block before: END may stand across the border.
        end = behindEnd(text, before - std::min<std::size_t>(before, 64));
        if (end != std::string::npos) break;
        if (got < kBlockBytes) {
            const bool last_line = trimmed(std::string_view(text).substr(text.find_last_of('\n') + 1)) == "END";
            if (!alone && !last_line) throw Error(Code::kCorrupt, file_ + ": the header has no END line");
            end = text.size();
        } else if (text.size() > kHeaderBytesMax) {
            throw Error(Code::kCorrupt, file_ + ": the header has no END line within its first 16 MiB");
        }
    }
    bytes_ = end;
    parse(std::string_view(text).substr(0, end));
}

void MrtrixText::parse(std::string_view text) {
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    for (std::size_t number = 2; !text.empty(); ++number) {
        const std::size_t length = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, length));
        text.remove_prefix(std::min(length + 1, text.size()));
        if (line == "END") return;
        if (line.empty() || line.front() == '#') continue;
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos || colon == 0) {
            throw Error(Code::kCorrupt,
                        file_ + ": line " + std::to_string(number) + " is " + shown(line) + "; it must be 'key: value'");
        }
        std::string key(trimmed(line.substr(0, colon)));
        std::ranges::transform(key, key.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        values_[key].emplace_back(trimmed(line.substr(colon + 1)));
    }
}

const std::string& MrtrixText::only(const std::string& key) const {
    const auto found = values_.find(key);
    if (found == values_.end()) throw Error(Code::kCorrupt, file_ + ": the header has no '" + key + "'; it is required");
    if (found->second.size() != 1) {
        throw Error(Code::kCorrupt, file_ + ": the header has '" + key + "' " + std::to_string(found->second.size()) +
                                        " times; it must stand there once");
    }
    return found->second.front();
}

std::vector<double> MrtrixText::numbers(const std::string& key) const {
    const auto found = values_.find(key);
    if (found == values_.end()) throw Error(Code::kCorrupt, file_ + ": the header has no '" + key + "'; it is required");
    std::vector<double> result;
    for (const std::string& line : found->second) {
        for (std::string_view part : splitList(line)) {
            if (part.starts_with('+')) part.remove_prefix(1);
            double value = 0;
            const auto [end, status] = std::from_chars(part.data(), part.data() + part.size(), value);
            if (status != std::errc() || end != part.data() + part.size()) {
                throw Error(Code::kCorrupt, file_ + ": " + key + " has " + shown(part) + "; it must be a number");
            }
            result.push_back(value);
        }
    }
    return result;
}

std::int64_t MrtrixText::integer(const std::string& key, std::string_view text) const {
    std::int64_t value = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc() || end != text.data() + text.size()) {
        throw Error(Code::kCorrupt, file_ + ": " + key + " has " + shown(text) + "; it must be a whole number of 64 bits");
    }
    return value;
}

}  // namespace radiata::io
