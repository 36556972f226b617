#include "render/frame/colour_tables.h"

#include <span>

namespace radiata::render {

std::uint64_t ColourTables::address(ColourMap map) {
    gpu::Buffer& buffer = made_[map];
    if (!buffer) {
        const auto bytes = std::as_bytes(std::span(linearColourTable(map)));
        buffer = gpu::Buffer(device_, bytes.size(), gpu::Memory::kDevice, "colour map");
        gpu::upload(device_, buffer, 0, bytes);
    }
    return buffer.address();
}

}  // namespace radiata::render
