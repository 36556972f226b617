// Draws the fiblets of one layer that can be seen: culled or not, by the layer's pipeline, of a tractogram that is on the
// device or one whose pages come as they are wanted.
#pragma once

#include <cstdint>

#include "render/frame/fiblet_cull.h"
#include "render/frame/fiblet_lines.h"
#include "render/frame/fiblet_raster.h"

namespace radiata::render {

class FibletDraw {
public:
    explicit FibletDraw(FibletRun& layer);

    FibletRaster& raster() { return raster_; }
    FibletCull& cull() { return cull_; }

    /// What layers begin with. \param empty  nothing that was drawn before is looked at
    void begin(bool empty);
    /// Of an opaque layer, as the plan has it.
    void draw();
    /// By two phases, the frustum, or the scheme of the coverage buffer.
    void drawCulled();
    /// Segments in the frustum, into the words as they are, with nothing known of a latest picture.
    void drawWords();
    /// Resolves, and draws and resolves once more as long as tangents are missing; what it counts it counts once.
    void settle(FibletRaster::Resolve how);
    /// The same of chains. \param slot  as in FibletRaster::resolveSheet()
    void settleSheet(std::uint32_t slot);

private:
    bool drawsMeshes() const;
    void drawAll();
    void drawListed(bool lines);
    void step(std::uint32_t phase, std::uint32_t first, std::uint32_t end);
    void drawPaged();
    void drawAllPages();
    void repair(std::uint32_t repaired);

    FibletRun& layer_;
    PassRun& run_;
    const plan::FibletPlan& plan_;
    const FibletScene& scene_;
    FibletBuffers& own_;
    FibletRaster raster_;
    FibletLines lines_;
    FibletCull cull_;
};

}  // namespace radiata::render
