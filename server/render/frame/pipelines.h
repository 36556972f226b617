// Compute pipelines by shader and specialisation, made when first needed: what a scene does not use is never compiled.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gpu/pipeline.h"

namespace radiata::render {

class Pipelines {
public:
    explicit Pipelines(gpu::Device& device) : device_(device) {}

    /// \param constants  specialisation constants 0, 1, ...
    const gpu::ComputePipeline& get(const std::string& shader, const std::vector<std::uint32_t>& constants);
    /// How many have been made so far.
    std::size_t count() const { return made_.size(); }

private:
    gpu::Device& device_;
    std::map<std::pair<std::string, std::vector<std::uint32_t>>, gpu::ComputePipeline> made_;
};

}  // namespace radiata::render
