// A piece of writing in a picture: orientation letters, convention, state. Where it stands, not how it is drawn.
#pragma once

#include <string>

#include "math/colour_map.h"

namespace radiata::model {

enum class MarkAlign { kStart, kCenter, kEnd };  ///< left/top, middle, right/bottom of the text at the anchor

/// Lists of marks are in order of importance: where two would overlap, the later one is left out.
struct Mark {
    std::string text;  ///< ASCII
    float x = 0;       ///< anchor, 0 left edge to 1 right edge of the picture
    float y = 0;       ///< anchor, 0 top to 1 bottom
    MarkAlign horizontal = MarkAlign::kStart;
    MarkAlign vertical = MarkAlign::kStart;
    int line = 0;    ///< lines of text between the anchor and this one: downwards, or upwards if aligned to the bottom
    float size = 1;  ///< relative to the picture's usual text
    bool operator==(const Mark&) const = default;
};

/// The legend of a colour map: a strip from the map's first colour (bottom) to its last (top), with a number at each end.
struct ColourBar {
    ColourMap map = ColourMap::kViridis;
    std::string title;  ///< what is mapped, with its unit; ASCII
    std::string low;    ///< number at the bottom
    std::string high;   ///< number at the top
    bool operator==(const ColourBar&) const = default;
};

}  // namespace radiata::model
