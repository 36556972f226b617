// Pipelines by shader and specialisation, made when first needed: what a scene does not use is never compiled.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gpu/graphics_pipeline.h"
#include "gpu/pipeline.h"

namespace radiata::render {

class Pipelines {
public:
    explicit Pipelines(gpu::Device& device) : device_(device) {}

    /// \param constants  specialisation constants 0, 1, ...
    const gpu::ComputePipeline& get(const std::string& shader, const std::vector<std::uint32_t>& constants);
    /// \param constants  of both stages
    const gpu::GraphicsPipeline& getGraphics(const std::string& vertex, const std::string& fragment,
                                             const std::vector<std::uint32_t>& constants, gpu::Faces faces);
    /// \param stages  modules of the stages in their order, the fragment shader last
    const gpu::GraphicsPipeline& getGraphics(const std::vector<std::pair<gpu::ShaderStage, std::string>>& stages,
                                             const std::vector<std::uint32_t>& constants, const gpu::Assembly& assembly);
    /// How many have been made so far.
    std::size_t count() const { return made_.size() + made_graphics_.size(); }

private:
    gpu::Device& device_;
    std::map<std::pair<std::string, std::vector<std::uint32_t>>, gpu::ComputePipeline> made_;
    /// By the modules' names in a row.
    std::map<std::pair<std::string, std::vector<std::uint32_t>>, gpu::GraphicsPipeline> made_graphics_;
};

}  // namespace radiata::render
