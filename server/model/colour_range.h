// Ends of a colour map.
#pragma once

namespace radiata::model {

struct ColourRange {
    float low = 0;
    float high = 1;
    bool operator==(const ColourRange&) const = default;
};

}  // namespace radiata::model
