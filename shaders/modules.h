// The SPIR-V modules that the build embeds.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace radiata::shaders {

struct Module {
    std::string_view name;
    std::span<const std::uint32_t> spirv;
};

/// \throws Error(kInternal) if there is no module of that name
const Module& module(std::string_view name);

}  // namespace radiata::shaders
