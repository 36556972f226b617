// What is asked of a Vulkan device, as one table.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "gpu/device.h"

#include <vulkan/vulkan_raii.hpp>

namespace radiata::gpu {

/// Vulkan's feature structures, chained. Those of extensions are only in the chain if their extension is named.
struct FeatureChain {
    vk::PhysicalDeviceFeatures2 core;
    vk::PhysicalDeviceVulkan11Features v11;
    vk::PhysicalDeviceVulkan12Features v12;
    vk::PhysicalDeviceVulkan13Features v13;
    vk::PhysicalDeviceAccelerationStructureFeaturesKHR acceleration;
    vk::PhysicalDeviceRayQueryFeaturesKHR ray_query;
    vk::PhysicalDeviceMeshShaderFeaturesEXT mesh;
    vk::PhysicalDeviceLineRasterizationFeaturesEXT lines;

    FeatureChain() = default;
    FeatureChain(const FeatureChain&) = delete;
    FeatureChain& operator=(const FeatureChain&) = delete;
    void link(const std::set<std::string>& extensions);
};

/// What a device answers when asked.
struct Abilities {
    explicit Abilities(const vk::raii::PhysicalDevice& physical);

    vk::PhysicalDeviceProperties properties;
    vk::PhysicalDeviceVulkan11Properties v11;
    std::set<std::string> extensions;
    FeatureChain features;                      ///< empty below Vulkan 1.3
    std::optional<std::uint32_t> queue_family;  ///< the first that computes and has timestamps, draws too if one does
    bool draws = false;                         ///< that family has graphics
};

struct FeatureRow {
    const char* name;
    std::optional<Feature> feature;  ///< what code asks Device::has() for
    const char* needed_by;
    const char* fallback;  ///< what is done without it; null: nothing runs without it
    std::vector<const char*> extensions;
    bool (*present)(const Abilities&);
    void (*enable)(FeatureChain&);
};

std::span<const FeatureRow> featureTable();

/// "Vulkan 1.3 (everything), ..." of what everything needs and this device lacks; empty if nothing.
std::string missingFeatures(const Abilities& abilities);

/// Rows that are there and were not left off.
/// \throws Error(kInvalidArgument) listing the names if `without` has an unknown one or one that everything needs
std::vector<const FeatureRow*> chosenFeatures(const Abilities& abilities, const std::vector<std::string>& without);

}  // namespace radiata::gpu
