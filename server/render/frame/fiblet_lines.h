// Layers of fibres by other pipelines than the compute shader of raster.comp: lines of the device's own rasteriser, whatever
// decodes them, and uncompressed points. Sources: Schertzer et al. 2022, Sec. 3 and 4.5; Schuetz et al. 2021 (points).
#pragma once

#include <cstdint>
#include <string>

#include "gpu/raster_target.h"
#include "plan/plan_fiblets.h"
#include "render/frame/fiblet_buffers.h"
#include "render/frame/pass_run.h"

namespace radiata::render {

/// Fiblets per submission, adapted to the last measured speed.
struct FibletPace {
    static constexpr double kSubmissionMs = 30;
    double fiblets = 4096;

    /// \param drawn  fiblets of a submission \param took_ms  its time
    void learn(std::uint64_t drawn, double took_ms);
};

/// What a view keeps for these pipelines, while its frames are drawn so.
struct FibletLineBuffers {
    gpu::RasterTarget images;
    gpu::Buffer words, depth;  ///< of the images
    gpu::Buffer slots;         ///< shader::FibletSlot[kSlots]; pull only
    gpu::Buffer command;       ///< VkDrawIndirectCommand; pull only

    static constexpr std::uint32_t kSlots = 16'384;
    /// Whose lines have room there too, as shader::FibletListedLine.
    static constexpr std::uint32_t kListedFiblets =
        kSlots * sizeof(shader::FibletSlot) / (shader::FIBLET_SEGMENTS * sizeof(shader::FibletListedLine));
    /// Makes room for a picture; keeps what fits. \throws Error(kResourceExhausted)
    void prepare(gpu::Device& device, std::uint32_t width, std::uint32_t height, model::FibletPipeline pipeline);
};

/// One layer while it is drawn. What is drawn is in the layer's words and tangents when a call returns.
class FibletLines {
public:
    /// \param suffix  of the names of passes
    FibletLines(PassRun& run, std::size_t layer, const FibletBuffers& own, FibletPace& pace, std::string suffix);

    /// Before anything of a sample is drawn.
    void begin();
    /// Fiblets [first, end) of the list, or of all. Of pipelines that draw uncompressed points: everything.
    void draw(bool listed, std::uint32_t first, std::uint32_t end);
    /// Pages [first, end) of the pages' order by mesh shaders, after a phase of culling (shaders/fiblet/cull.comp; 3: none).
    /// \param counts  adds the fiblets that are drawn to the layer's `listed`
    void drawPages(std::uint32_t phase, std::uint32_t first, std::uint32_t end, bool counts);

private:
    /// Whether lines may stand for many segments (shaders/fiblet/line_detail.glsl).
    bool fewerLines() const { return own_.layer().detail_segments > 0 || plan_.culling == model::FibletCulling::kCoverage; }
    std::vector<std::uint32_t> constants(std::uint32_t phase, bool listed, bool counts) const;
    const gpu::GraphicsPipeline& pipeline(std::uint32_t phase, bool listed, bool counts);
    void pull(bool listed, std::uint32_t first, std::uint32_t end);
    void meshes(std::uint32_t first, std::uint32_t end);
    void strips();
    void points();
    void merge();
    void submit(std::uint64_t fiblets);

    PassRun& run_;
    std::size_t index_;
    const plan::FibletPlan& plan_;
    const FibletBuffers& own_;
    FibletPace& pace_;
    std::string suffix_;
};

}  // namespace radiata::render
