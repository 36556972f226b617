#include "math/colour_map.h"

#include <cmath>

#include "math/colour_map_tables.h"

namespace radiata {
namespace {

float digit(char c) { return static_cast<float>(c <= '9' ? c - '0' : c - 'a' + 10); }

ColourTable fromHexadecimal(std::string_view text) {
    ColourTable table;
    for (std::size_t i = 0; i < table.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const std::size_t at = 6 * i + 2 * static_cast<std::size_t>(c);
            table[i][c] = (16 * digit(text[at]) + digit(text[at + 1])) / 255;
        }
    }
    return table;
}

template <typename Colour>
ColourTable fromFormula(Colour&& colour) {
    ColourTable table;
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = colour(static_cast<float>(i) / 255);
    return table;
}

ColourTable makeTable(ColourMap map) {
    switch (map) {
        case ColourMap::kViridis:
            return fromHexadecimal(colour_maps::kViridis);
        case ColourMap::kInferno:
            return fromHexadecimal(colour_maps::kInferno);
        case ColourMap::kCividis:
            return fromHexadecimal(colour_maps::kCividis);
        case ColourMap::kBlackRedYellow:
            return fromFormula([](float x) { return glm::vec3(glm::min(2 * x, 1.0F), glm::clamp(2 * x - 1, 0.0F, 1.0F), 0); });
        case ColourMap::kGrey:
            break;
    }
    return fromFormula([](float x) { return glm::vec3(x); });
}

/// IEC 61966-2-1.
float linear(float encoded) { return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F); }

constexpr std::size_t kCount = 5;

std::array<ColourTable, kCount> makeTables(bool linear_light) {
    std::array<ColourTable, kCount> tables;
    for (std::size_t m = 0; m < kCount; ++m) {
        tables[m] = makeTable(static_cast<ColourMap>(m));
        if (!linear_light) continue;
        for (glm::vec3& colour : tables[m]) colour = {linear(colour.x), linear(colour.y), linear(colour.z)};
    }
    return tables;
}

}  // namespace

const ColourTable& colourTable(ColourMap map) {
    static const std::array<ColourTable, kCount> kTables = makeTables(false);
    return kTables[static_cast<std::size_t>(map)];
}

const ColourTable& linearColourTable(ColourMap map) {
    static const std::array<ColourTable, kCount> kTables = makeTables(true);
    return kTables[static_cast<std::size_t>(map)];
}

std::string_view name(ColourMap map) {
    switch (map) {
        case ColourMap::kViridis:
            return "viridis";
        case ColourMap::kInferno:
            return "inferno";
        case ColourMap::kCividis:
            return "cividis";
        case ColourMap::kBlackRedYellow:
            return "black-red-yellow";
        case ColourMap::kGrey:
            break;
    }
    return "grey";
}

}  // namespace radiata
