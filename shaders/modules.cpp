#include "shaders/modules.h"

#include <string>

#include "base/error.h"

extern "C" {
#define MODULE(name) extern const std::uint32_t spirv_##name##_begin[], spirv_##name##_end[];
#include "modules.inc"
#undef MODULE
}

namespace radiata::shaders {

const Module& module(std::string_view name) {
    static const Module kModules[] = {
#define MODULE(name) {#name, {spirv_##name##_begin, spirv_##name##_end}},
#include "modules.inc"
#undef MODULE
    };
    for (const Module& candidate : kModules) {
        if (candidate.name == name) return candidate;
    }
    throw Error(Code::kInternal, "no shader module is named '" + std::string(name) + "'");
}

}  // namespace radiata::shaders
