// The pipeline cache on disk: a header of our own (magic, size, checksum), then the driver's bytes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include <vulkan/vulkan.hpp>

namespace radiata::gpu {

/// The driver's bytes, or nothing if the file is missing, damaged, or of another device or driver.
/// The checksum is there because drivers trust what comes behind a matching header.
std::vector<std::byte> readPipelineCache(const std::filesystem::path& file, const vk::PhysicalDeviceProperties& device);

/// Replaces the file in one step, so that no reader ever sees half of it.
/// \throws Error(kUnavailable) naming the file
void writePipelineCache(const std::filesystem::path& file, std::span<const std::byte> bytes);

}  // namespace radiata::gpu
