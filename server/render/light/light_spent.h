// What lighting a picture took.
#pragma once

#include <cstdint>

namespace radiata::render {

struct LightSpent {
    std::uint64_t samples = 0;  ///< paths
    double seconds = 0;
};

}  // namespace radiata::render
