// Colour maps: from a number between 0 and 1 to a colour.
#pragma once

#include <array>
#include <string_view>

#include <glm/glm.hpp>

namespace radiata {

/// kViridis, kInferno, kCividis: perceptually uniform (math/colour_map_tables.h has their sources). kBlackRedYellow: straight
/// lines in sRGB from black by red to yellow, the map of Hlawitschka's figure of colour codings. kGrey: sRGB black to white.
enum class ColourMap { kViridis, kInferno, kCividis, kBlackRedYellow, kGrey };

/// Colours at 0, 1/255, ... 1; between them colours are interpolated linearly in linear RGB.
using ColourTable = std::array<glm::vec3, 256>;

/// sRGB, each channel 0 to 1.
const ColourTable& colourTable(ColourMap map);
/// The same in linear RGB, which shaders and light use.
const ColourTable& linearColourTable(ColourMap map);

/// "viridis", "inferno", "cividis", "black-red-yellow", "grey"
std::string_view name(ColourMap map);

}  // namespace radiata
