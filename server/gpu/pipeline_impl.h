// What a ComputePipeline holds, shared by gpu/*.cpp only.
#pragma once

#include "gpu/device_impl.h"
#include "gpu/pipeline.h"

namespace radiata::gpu {

struct ComputePipeline::Impl {
    std::string shader_name;
    vk::raii::Pipeline pipeline{nullptr};
};

}  // namespace radiata::gpu
