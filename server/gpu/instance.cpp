#include "gpu/instance.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstring>
#include <optional>

#include "gpu/device_features.h"

namespace radiata::gpu {
namespace {

const char* const kLayer = "VK_LAYER_KHRONOS_validation";
constexpr std::size_t kMessagesMax = 1000;  // a message per dispatch of a long run must not fill the memory

VKAPI_ATTR VkBool32 VKAPI_CALL collect(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto& log = *static_cast<MessageLog*>(user);
    std::lock_guard lock(log.mutex);
    if (log.messages.size() < kMessagesMax) log.messages.emplace_back(data->pMessage);
    return VK_FALSE;
}

int rank(const vk::raii::PhysicalDevice& device) {
    switch (device.getProperties().deviceType) {
        case vk::PhysicalDeviceType::eDiscreteGpu:
            return 4;
        case vk::PhysicalDeviceType::eIntegratedGpu:
            return 3;
        case vk::PhysicalDeviceType::eVirtualGpu:
            return 2;
        case vk::PhysicalDeviceType::eCpu:
            return 1;
        default:
            return 0;
    }
}

std::string deviceName(const vk::raii::PhysicalDevice& device) { return device.getProperties().deviceName; }

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::optional<std::size_t> asNumber(const std::string& text) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

}  // namespace

vk::raii::Instance makeInstance(const vk::raii::Context& context, bool validation) {
    const vk::ApplicationInfo application{.pApplicationName = "radiata", .apiVersion = VK_API_VERSION_1_3};
    const std::array enabled{vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
    const vk::ValidationFeaturesEXT features{.enabledValidationFeatureCount = enabled.size(),
                                             .pEnabledValidationFeatures = enabled.data()};
    const std::array extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    vk::InstanceCreateInfo info{.pApplicationInfo = &application};
    if (validation) {
        const auto layers = context.enumerateInstanceLayerProperties();
        if (std::ranges::none_of(layers, [](const auto& layer) { return std::strcmp(layer.layerName, kLayer) == 0; })) {
            throw Error(Code::kUnavailable, std::string("validation needs the layer ") + kLayer +
                                                ", which is not installed (Debian: vulkan-validationlayers)");
        }
        info.setPNext(&features).setEnabledLayerCount(1).setPpEnabledLayerNames(&kLayer);
        info.setEnabledExtensionCount(extensions.size()).setPpEnabledExtensionNames(extensions.data());
    }
    try {
        return {context, info};
    } catch (const vk::SystemError& error) {
        throw Error(Code::kUnavailable,
                    std::string("no Vulkan instance could be made; is a Vulkan 1.3 driver installed? ") + error.what());
    }
}

vk::raii::DebugUtilsMessengerEXT makeMessenger(const vk::raii::Instance& instance, MessageLog& log) {
    using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
    // Messages of type "general" are the loader's, about drivers that are not ours.
    return {instance, vk::DebugUtilsMessengerCreateInfoEXT{.messageSeverity = Severity::eWarning | Severity::eError,
                                                           .messageType = Type::eValidation | Type::ePerformance,
                                                           .pfnUserCallback = collect,
                                                           .pUserData = &log}};
}

std::vector<vk::raii::PhysicalDevice> listDevices(const vk::raii::Instance& instance) {
    try {
        std::vector<vk::raii::PhysicalDevice> devices;
        for (auto& device : vk::raii::PhysicalDevices(instance)) devices.push_back(std::move(device));
        if (!devices.empty()) return devices;
    } catch (const vk::SystemError& error) {
        throw Error(Code::kUnavailable, std::string("Vulkan devices could not be listed: ") + error.what());
    }
    throw Error(Code::kUnavailable, "there is no Vulkan device (Debian: mesa-vulkan-drivers has one that runs on the CPU)");
}

vk::raii::PhysicalDevice chooseDevice(const vk::raii::Instance& instance, const std::string& wanted) {
    const std::vector<vk::raii::PhysicalDevice> devices = listDevices(instance);
    const std::optional<std::size_t> number = asNumber(wanted);
    std::vector<const vk::raii::PhysicalDevice*> fitting;
    if (number && *number < devices.size()) {
        fitting.push_back(&devices[*number]);
    } else {
        for (const auto& device : devices) {
            if (lower(deviceName(device)).find(lower(wanted)) != std::string::npos) fitting.push_back(&device);
        }
    }
    if (fitting.empty()) {
        std::string names;
        for (std::size_t i = 0; i < devices.size(); ++i) {
            names += (i == 0 ? "" : ", ") + std::to_string(i) + " '" + deviceName(devices[i]) + "'";
        }
        throw Error(Code::kNotFound, "no Vulkan device is called '" + wanted + "' or has that number; there are: " + names);
    }
    std::ranges::stable_sort(fitting, std::greater{}, [](const auto* device) { return rank(*device); });
    std::string reasons;
    for (const auto* device : fitting) {
        const std::string missing = missingFeatures(Abilities(*device));
        if (missing.empty()) return *device;
        reasons += (reasons.empty() ? "'" : "; '") + deviceName(*device) + "' lacks " + missing;
    }
    throw Error(Code::kUnsupported, "no Vulkan device can do what everything needs: " + reasons);
}

}  // namespace radiata::gpu
