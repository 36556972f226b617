// Turns what Vulkan throws into the project's one exception type.
#pragma once

#include <string>

#include <vulkan/vulkan.hpp>

#include "base/error.h"

namespace radiata::gpu {

/// Error(kResourceExhausted) for memory, Error(kUnavailable) for a lost or missing device, Error(kUnsupported) for a missing
/// feature, else Error(kInternal). \param what  what was being done, e.g. "creating buffer 'glyphs'"
inline Error toError(const vk::SystemError& error, const std::string& what) {
    Code code = Code::kInternal;
    switch (static_cast<vk::Result>(error.code().value())) {
        case vk::Result::eErrorOutOfHostMemory:
        case vk::Result::eErrorOutOfDeviceMemory:
        case vk::Result::eErrorOutOfPoolMemory:
        case vk::Result::eErrorTooManyObjects:
            code = Code::kResourceExhausted;
            break;
        case vk::Result::eErrorDeviceLost:
        case vk::Result::eErrorInitializationFailed:
        case vk::Result::eErrorIncompatibleDriver:
            code = Code::kUnavailable;
            break;
        case vk::Result::eErrorLayerNotPresent:
        case vk::Result::eErrorExtensionNotPresent:
        case vk::Result::eErrorFeatureNotPresent:
            code = Code::kUnsupported;
            break;
        default:
            break;
    }
    return Error(code, what + " failed: " + error.what());
}

}  // namespace radiata::gpu
