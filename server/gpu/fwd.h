// Names of the device layer, for headers that need no Vulkan.
#pragma once

namespace radiata::gpu {
class Device;
class Buffer;
class ComputePipeline;
class GraphicsPipeline;
class RasterTarget;
class CommandRecorder;
}  // namespace radiata::gpu
