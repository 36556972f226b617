#include "shaders/modules.h"

#include <string>

#include "base/error.h"
#include "modules.inc"

namespace radiata::shaders {

const Module& module(std::string_view name) {
    for (const Module& candidate : kModules) {
        if (candidate.name == name) return candidate;
    }
    throw Error(Code::kInternal, "no shader module is named '" + std::string(name) + "'");
}

}  // namespace radiata::shaders
