#include "common/table.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>

namespace radiata::client {
namespace {

bool numeric(const std::string& cell) {
    return !cell.empty() && (std::isdigit(static_cast<unsigned char>(cell[0])) || cell[0] == '-' || cell[0] == '+');
}

}  // namespace

std::string formatTable(const Row& header, const std::vector<Row>& rows) {
    std::vector<std::size_t> widths(header.size());
    std::vector<bool> right(header.size(), !rows.empty());
    for (std::size_t c = 0; c < header.size(); ++c) {
        widths[c] = header[c].size();
        for (const Row& row : rows) {
            widths[c] = std::max(widths[c], row[c].size());
            right[c] = right[c] && numeric(row[c]);
        }
    }
    std::string text;
    const auto append = [&](const Row& row) {
        std::string line;
        for (std::size_t c = 0; c < header.size(); ++c) {
            const std::string gap(widths[c] - row[c].size(), ' ');
            line += (c == 0 ? "" : "  ") + (right[c] ? gap + row[c] : row[c] + gap);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    };
    append(header);
    for (const Row& row : rows) append(row);
    return text;
}

std::string formatBytes(double bytes) {
    constexpr std::array kUnits = {"bytes", "KiB", "MiB", "GiB", "TiB"};
    std::size_t unit = 0;
    while (bytes >= 1024 && unit + 1 < kUnits.size()) {
        bytes /= 1024;
        ++unit;
    }
    return formatNumber(bytes, unit == 0 ? 0 : 1) + " " + kUnits[unit];
}

std::string formatNumber(double value, int digits) {
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.*f", digits, value);
    return buffer.data();
}

}  // namespace radiata::client
