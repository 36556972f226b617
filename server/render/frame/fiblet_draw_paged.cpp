// Drawing fiblets of a tractogram that is not all on the device (render/fiblet/fiblet_residency.h).
#include <algorithm>
#include <span>
#include <vector>

#include "render/frame/fiblet_draw.h"

namespace radiata::render {

/// What is seen of a page depends on the subset and on nearer pages alone, so a picture for which all pages came that have room
/// does not depend on what was drawn before.
void FibletDraw::drawPaged() {
    const std::uint32_t pages = own_.orderPages(scene_);
    own_.drawn = own_.pages_wanted = own_.pages_left_out = 0;
    if (run_.list.all_pages) return drawAllPages();
    std::vector<std::uint32_t> missing;
    const auto draw = [&](std::uint32_t phase, std::uint32_t first, std::uint32_t end) {
        cull_.cullPaged(phase, first, end, missing);
        drawListed(true);
    };
    if (layer_.inTwoPhases()) {
        cull_.inParts(pages, [&](std::uint32_t first, std::uint32_t end) { draw(3, first, end); });
    } else {
        draw(0, 0, pages);
    }
    scene_.residency()->want(run_.recorder, missing);
    own_.pages_missing = missing.size();
    run_.target.pages_missing = run_.target.pages_missing || !missing.empty();
}

/// Everything in the frustum, in as many rounds as the pages need that have room beside each other.
void FibletDraw::drawAllPages() {
    FibletResidency& residency = *scene_.residency();
    const std::vector<std::uint32_t> found = cull_.foundPages(0, 0, static_cast<std::uint32_t>(scene_.pages().size()));
    own_.pages_wanted = found.size();
    own_.drawn = 0;
    for (std::size_t first = 0; first < found.size(); first += residency.slots()) {
        run_.checkCancelled();
        const auto round = std::span(found).subspan(first, std::min<std::size_t>(residency.slots(), found.size() - first));
        residency.begin();
        for (const std::uint32_t page : round) residency.take(page);
        residency.fetch(run_.recorder, round, {}, run_.cancel);
        own_.counts().listed = 0;
        cull_.cullFound(0, round);
        raster_.draw(true, 0, own_.counts().listed);
        own_.drawn += own_.counts().listed;
    }
}

}  // namespace radiata::render
