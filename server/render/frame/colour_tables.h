// Colour maps on the device, each made when first needed: a scene without one has none.
#pragma once

#include <map>

#include "gpu/buffer.h"
#include "math/colour_map.h"

namespace radiata::render {

class ColourTables {
public:
    explicit ColourTables(gpu::Device& device) : device_(device) {}

    /// Address of vec3[256], linear RGB. \throws Error(kResourceExhausted)
    std::uint64_t address(ColourMap map);

private:
    gpu::Device& device_;
    std::map<ColourMap, gpu::Buffer> made_;
};

}  // namespace radiata::render
