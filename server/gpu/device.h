// One Vulkan device with one queue: chosen by flag, asked what it can do, and nothing more.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace radiata::gpu {

/// What a device may or may not be able to do; device_features.cpp says who needs it and what is done without it.
enum class Feature {
    kRayQuery,
    kInt64Atomics,
    kMeshShader,
    kSubgroupBallot,
    kFullSubgroups,
    kMemoryBudget,
    kRaster,
    kFloat64,
    kLines,
    kWideLines,
    kGeometryShader,
    kTessellationShader,
    kMeshSubgroups
};
constexpr std::size_t kFeatureCount = 13;

struct DeviceOptions {
    std::string device{};                    ///< number in list(), or a part of the name; empty: the most capable one
    bool validation = false;                 ///< validation layers with synchronisation validation
    std::filesystem::path pipeline_cache{};  ///< file; empty: none is kept
    std::vector<std::string> without{};      ///< features to leave off by name, e.g. "ray_query"
};

struct DeviceInfo {
    std::string name;
    std::string driver;  ///< name and version
    std::uint32_t subgroup_size = 0;
    std::uint64_t storage_range_max = 0;  ///< bytes
    std::uint64_t memory_bytes = 0;       ///< largest device-local heap
    float line_width_max = 1;             ///< pixels, of Feature::kLines
    std::uint32_t line_frame_px = 4096;   ///< edge of the viewport of CommandRecorder::drawLines(), about the target's middle
    bool software = false;                ///< a CPU rasteriser
};

class Device {
public:
    /// \throws Error(kUnavailable) if there is no Vulkan device, Error(kNotFound) listing the devices if none fits `device`,
    ///         Error(kUnsupported) naming the missing feature if the device lacks what everything needs
    explicit Device(const DeviceOptions& options);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const;
    bool has(Feature feature) const;
    /// Bytes of device memory that live Buffers take.
    std::uint64_t allocatedBytes() const;
    /// What the validation layers said since the last call; empty means clean (or no validation).
    std::vector<std::string> takeValidationMessages();
    /// Writes the pipeline cache file if one was named. Also done on destruction.
    void savePipelineCache();

    /// Names of all devices, in the order of their numbers.
    static std::vector<std::string> list();

    struct Impl;  ///< vk::raii objects, seen by gpu/*.cpp only (gpu/device_impl.h)
    Impl& impl() const { return *impl_; }

private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace radiata::gpu
