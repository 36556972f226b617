#include "io/text.h"

#include <algorithm>

namespace radiata::io {

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string_view> splitList(std::string_view list) {
    std::vector<std::string_view> parts;
    while (true) {
        const std::size_t first = list.find_first_not_of(", \t");
        if (first == std::string_view::npos) return parts;
        const std::size_t end = std::min(list.find_first_of(", \t", first), list.size());
        parts.push_back(list.substr(first, end - first));
        list.remove_prefix(end);
    }
}

std::string shown(std::string_view text) {
    constexpr std::size_t kMost = 60;
    std::string line(text.substr(0, kMost));
    std::ranges::replace_if(
        line, [](unsigned char c) { return c < 32 || c > 126; }, '?');
    return "'" + line + (text.size() > kMost ? "...'" : "'");
}

}  // namespace radiata::io
