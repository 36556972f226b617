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

const gpu::GraphicsPipeline& Pipelines::getGraphics(const std::string& vertex, const std::string& fragment,
                                                    const std::vector<std::uint32_t>& constants, gpu::Faces faces) {
    auto key = std::make_pair(fragment, constants);
    const auto found = made_graphics_.find(key);
    if (found != made_graphics_.end()) return found->second;
    const shaders::Module &first = shaders::module(vertex), &second = shaders::module(fragment);
    gpu::GraphicsPipeline pipeline(device_, gpu::Shader{first.name, first.spirv}, gpu::Shader{second.name, second.spirv},
                                   constants, faces);
    return made_graphics_.emplace(std::move(key), std::move(pipeline)).first->second;
}

}  // namespace radiata::render
