#include "render/frame/pipelines.h"

#include "shaders/modules.h"

namespace radiata::render {

const gpu::ComputePipeline& Pipelines::get(const std::string& shader, const std::vector<std::uint32_t>& constants) {
    auto key = std::make_pair(shader, constants);
    const auto found = made_.find(key);
    if (found != made_.end()) return found->second;
    const shaders::Module& module = shaders::module(shader);
    gpu::ComputePipeline pipeline(device_, gpu::Shader{module.name, module.spirv}, constants);
    return made_.emplace(std::move(key), std::move(pipeline)).first->second;
}

}  // namespace radiata::render
