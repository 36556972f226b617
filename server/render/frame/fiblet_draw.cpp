#include "render/frame/fiblet_draw.h"

#include <memory>

#include "plan/fiblet_view.h"
#include "render/frame/fiblet_coverage.h"
#include "render/frame/fiblet_line_buffers.h"

namespace radiata::render {

FibletDraw::FibletDraw(FibletRun& layer)
    : layer_(layer),
      run_(layer.run),
      plan_(layer.plan),
      scene_(layer.scene),
      own_(layer.own),
      raster_(layer),
      lines_(layer),
      cull_(layer) {}

bool FibletDraw::drawsMeshes() const {
    const bool meshes = plan_.pipeline == model::FibletPipeline::kMesh || plan_.pipeline == model::FibletPipeline::kMeshSerial;
    return meshes && plan_.lines && !raster_.drawsLines();
}

void FibletDraw::begin(bool empty) {
    raster_.begin(empty);
    if (raster_.use.chain != 0) return;
    if (raster_.drawsLines()) {
        run_.target.fiblet_lines.reset();
    } else {
        lines_.begin();
    }
}

void FibletDraw::draw() {
    if (!layer_.mayBeSeen()) return;
    if (plan_.paged) return drawPaged();
    const bool frustum = plan_.culling == model::FibletCulling::kFrustum;
    if (plan_.culling == model::FibletCulling::kNone || (frustum && plan::areInside(own_.layer().view, scene_.pages()))) {
        drawAll();
    } else if (run_.list.frozen) {
        step(1, 0, own_.orderPages(scene_));
    } else {
        drawCulled();
    }
}

void FibletDraw::drawCulled() {
    const std::uint32_t pages = own_.orderPages(scene_);
    own_.drawn = 0;
    if (layer_.byCoverage()) {
        if (!own_.coverage) own_.coverage = std::make_unique<FibletCoverage>();
        own_.coverage->cull(layer_);
        layer_.submit(0);
        return drawListed(true);
    }
    if (!layer_.inTwoPhases()) return step(0, 0, pages);
    if (own_.knows_visible) {
        step(1, 0, pages);
    } else {
        run_.recorder.fill(own_.visible, 0, own_.visible.sizeBytes() / 4 * 4, 0);
    }
    cull_.inParts(pages, [this](std::uint32_t first, std::uint32_t end) { step(2, first, end); });
}

void FibletDraw::drawWords() {
    own_.counts() = {};
    if (!layer_.mayBeSeen()) return;
    if (plan_.paged) return drawPaged();
    if (plan_.culling == model::FibletCulling::kNone) {
        raster_.draw(false, 0, static_cast<std::uint32_t>(scene_.fibletCount()));
    } else {
        const std::uint32_t pages = own_.orderPages(scene_);
        // What lies before nothing but pixels that are done is not drawn again.
        const bool hides = raster_.use.peeling;
        if (hides) cull_.pyramid();
        cull_.cull(hides ? 3 : 0, 0, pages);
        raster_.draw(true, 0, own_.counts().listed);
    }
    own_.drawn = own_.counts().listed;
}

void FibletDraw::settle(FibletRaster::Resolve how) {
    std::uint32_t repaired = raster_.resolve(how);
    // With the same shaders: whether anything is drawn once more depends on what ran in parallel.
    how.counts = false;
    while (repaired > 0) {
        repair(repaired);
        repaired = raster_.resolve(how);
    }
}

void FibletDraw::settleSheet(std::uint32_t slot) {
    while (const std::uint32_t repaired = raster_.resolveSheet(slot)) repair(repaired);
}

/// Draws once more what is listed as it has lost its directions.
void FibletDraw::repair(std::uint32_t repaired) {
    if (plan_.paged && run_.list.all_pages) {
        drawAllPages();
    } else {
        raster_.draw(true, 0, repaired);
    }
}

/// Draws what a phase of culling leaves of some pages in their order.
void FibletDraw::step(std::uint32_t phase, std::uint32_t first, std::uint32_t end) {
    const bool meshes = drawsMeshes();
    if (meshes) lines_.drawPages(phase, first, end, !plan_.tubes);
    if (!meshes || plan_.tubes) cull_.cull(phase, first, end);
    drawListed(!meshes);
}

/// What is new in the list. \param lines  not only tubes
void FibletDraw::drawListed(bool lines) {
    const std::uint32_t listed = own_.counts().listed, drawn = static_cast<std::uint32_t>(own_.drawn);
    if (!raster_.drawsLines() && lines && plan_.lines) lines_.draw(true, drawn, listed);
    if (raster_.drawsLines() || plan_.tubes) raster_.draw(true, drawn, listed);
    own_.drawn = listed;
}

void FibletDraw::drawAll() {
    const auto all = static_cast<std::uint32_t>(scene_.fibletCount());
    if (drawsMeshes()) {
        lines_.drawPages(3, 0, static_cast<std::uint32_t>(scene_.pages().size()), false);
    } else if (!raster_.drawsLines() && plan_.lines) {
        lines_.draw(false, 0, all);
    }
    if (raster_.drawsLines() || plan_.tubes) raster_.draw(false, 0, all);
    own_.drawn = all;
}

}  // namespace radiata::render
