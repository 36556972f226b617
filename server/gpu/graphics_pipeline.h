// Pipelines that draw triangles or lines into a RasterTarget. As with compute, their whole interface is one block of push
// constants: vertices are fetched from buffers by address, and there are no descriptor sets.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "gpu/pipeline.h"

namespace radiata::gpu {

enum class Faces { kAll, kBack };  ///< back: those whose corners run clockwise as seen
enum class ShaderStage { kVertex, kGeometry, kTessellationControl, kTessellationEvaluation, kTask, kMesh, kFragment };
/// What comes in; kPatches: one control point each. Of task and mesh shaders, and of geometry shaders, what goes out counts,
/// and `kLines` says that it is lines.
enum class Primitives { kTriangles, kLines, kLineStrips, kPointsToLines, kPatchesToLines };

struct StageShader {
    ShaderStage stage;
    Shader shader;
};

/// How what the shaders make is rasterised.
struct Assembly {
    Primitives primitives = Primitives::kTriangles;
    Faces faces = Faces::kAll;  ///< of triangles
    float line_width = 1;       ///< pixels; lines have one fragment for each pixel along their longer axis, replicated across
};

/// The greater depth wins, the earlier of equal ones. What is written as depth is from 0 (excluded) to 1.
class GraphicsPipeline {
public:
    GraphicsPipeline();
    /// \param stages     in their order, the fragment shader last
    /// \param constants  specialisation constants of all stages; constants[i] has constant_id i
    /// \throws Error(kUnsupported or kInternal) naming the fragment shader
    GraphicsPipeline(Device& device, std::span<const StageShader> stages, std::span<const std::uint32_t> constants,
                     const Assembly& assembly);
    ~GraphicsPipeline();
    GraphicsPipeline(GraphicsPipeline&&) noexcept;
    GraphicsPipeline& operator=(GraphicsPipeline&&) noexcept;
    explicit operator bool() const { return impl_ != nullptr; }
    /// Of the fragment shader.
    const std::string& shaderName() const;

    struct Impl;
    const Impl& impl() const { return *impl_; }

private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace radiata::gpu
