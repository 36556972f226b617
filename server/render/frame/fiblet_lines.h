// Layers of fibres by other pipelines than the compute shader of raster.comp: lines of the device's own rasteriser, whatever
// decodes them, and uncompressed points. Sources: Schertzer et al. 2022, Sec. 3 and 4.5; Schuetz et al. 2021 (points).
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/graphics_pipeline.h"
#include "render/frame/fiblet_run.h"

namespace radiata::render {

/// One layer while it is drawn. What is drawn is in the layer's words and tangents when a call returns.
class FibletLines {
public:
    explicit FibletLines(FibletRun& layer);

    /// Before anything of a sample is drawn.
    void begin();
    /// Fiblets [first, end) of the list, or of all. Of pipelines that draw uncompressed points: everything.
    void draw(bool listed, std::uint32_t first, std::uint32_t end);
    /// Pages [first, end) of the pages' order by mesh shaders, after a phase of culling (shaders/fiblet/cull.comp; 3: none).
    /// \param counts  adds the fiblets that are drawn to the layer's `listed`
    void drawPages(std::uint32_t phase, std::uint32_t first, std::uint32_t end, bool counts);

private:
    /// Whether lines may stand for many segments (shaders/fiblet/line_detail.glsl).
    bool fewerLines() const { return own_.layer().detail_segments > 0 || layer_.byCoverage(); }
    std::vector<std::uint32_t> constants(std::uint32_t phase, bool listed, bool counts) const;
    const gpu::GraphicsPipeline& pipeline(std::uint32_t phase, bool listed, bool counts);
    void pull(bool listed, std::uint32_t first, std::uint32_t end);
    void meshes(std::uint32_t first, std::uint32_t end);
    void strips();
    void points();
    void merge();

    FibletRun& layer_;
    PassRun& run_;
    const plan::FibletPlan& plan_;
    const FibletBuffers& own_;
};

}  // namespace radiata::render
