// The Vulkan instance, its validation, and the choice of a device.
#pragma once

#include <string>
#include <vector>

#include "gpu/device_impl.h"

namespace radiata::gpu {

/// \throws Error(kUnavailable) without a Vulkan driver, or if validation is asked for and its layer is not installed
vk::raii::Instance makeInstance(const vk::raii::Context& context, bool validation);
/// Collects warnings and errors in `log`, which must outlive it.
vk::raii::DebugUtilsMessengerEXT makeMessenger(const vk::raii::Instance& instance, MessageLog& log);

/// Devices in the order of their numbers. \throws Error(kUnavailable) if there is none
std::vector<vk::raii::PhysicalDevice> listDevices(const vk::raii::Instance& instance);
/// See DeviceOptions::device; among several of one name, or without one: discrete, then integrated, virtual, CPU.
/// \throws as the constructor of Device
vk::raii::PhysicalDevice chooseDevice(const vk::raii::Instance& instance, const std::string& wanted);

}  // namespace radiata::gpu
