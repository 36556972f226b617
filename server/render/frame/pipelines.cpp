#include "render/frame/pipelines.h"

#include <bit>

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
    return getGraphics({{gpu::ShaderStage::kVertex, vertex}, {gpu::ShaderStage::kFragment, fragment}}, constants,
                       {.faces = faces});
}

const gpu::GraphicsPipeline& Pipelines::getGraphics(const std::vector<std::pair<gpu::ShaderStage, std::string>>& stages,
                                                    const std::vector<std::uint32_t>& constants,
                                                    const gpu::Assembly& assembly) {
    std::string names;
    for (const auto& [stage, name] : stages) names += name + " ";
    std::vector<std::uint32_t> all = constants;
    all.push_back(static_cast<std::uint32_t>(assembly.faces));
    all.push_back(std::bit_cast<std::uint32_t>(assembly.line_width));
    auto key = std::make_pair(names, std::move(all));
    const auto found = made_graphics_.find(key);
    if (found != made_graphics_.end()) return found->second;
    std::vector<gpu::StageShader> modules;
    for (const auto& [stage, name] : stages) {
        const shaders::Module& module = shaders::module(name);
        modules.push_back({stage, {module.name, module.spirv}});
    }
    gpu::GraphicsPipeline pipeline(device_, modules, constants, assembly);
    return made_graphics_.emplace(std::move(key), std::move(pipeline)).first->second;
}

}  // namespace radiata::render
