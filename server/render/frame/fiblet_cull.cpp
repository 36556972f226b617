#include "render/frame/fiblet_cull.h"

#include <algorithm>
#include <bit>
#include <iterator>

namespace radiata::render {
namespace {

/// Workgroups of one dispatch; every device takes 65,535.
constexpr std::uint32_t kPagesAtOnce = 16'384;

struct CullPagesPush {
    std::uint64_t layer, found;
    std::uint32_t first_page, page_count;
};
struct CullPush {
    std::uint64_t layer, pages;
};
struct PyramidPush {
    std::uint64_t layer;
    std::uint32_t source, target;
    glm::ivec2 source_size;
};

}  // namespace

void FibletCull::cull(std::uint32_t phase, std::uint32_t first, std::uint32_t end) {
    findPages(phase, first, end, own_.found_pages);
    cullPages(phase, own_.found_pages, own_.counts().pages);
}

/// How far what is drawn reaches beside it, pixels, as a constant of pipelines.
std::uint32_t FibletCull::margin() const {
    // A line of w pixels reaches (w - 1) / 2 beside its middle; one of w across w / 2 times the root of 2, less half a pixel.
    const auto width = static_cast<float>(plan_.line_width_px);
    return std::bit_cast<std::uint32_t>(plan_.exact_width ? 0.7072F * width : 0.5F * (width - 1));
}

/// Pages of which something can be seen, in no order.
void FibletCull::findPages(std::uint32_t phase, std::uint32_t first, std::uint32_t end, const gpu::Buffer& into) {
    own_.counts().pages = 0;
    run_.recorder.dispatch(run_.pipelines.get("fiblet_cull_pages", {PassRun::kGroup, phase, margin(), plan_.tubes ? 1U : 0U}),
                           "fiblet cull" + layer_.suffix, PassRun::groups(end - first), 1, 1,
                           CullPagesPush{own_.layerAddress(), into.address(), first, end - first});
    run_.recorder.submitAndWait();
}

void FibletCull::cullPages(std::uint32_t phase, const gpu::Buffer& numbers, std::uint32_t pages) {
    const gpu::ComputePipeline& pipeline = run_.pipelines.get(
        "fiblet_cull",
        layer_.withPaged({FibletScene::kPageFiblets, phase, margin(), plan_.tubes ? 1U : 0U, plan_.segments ? 1U : 0U}));
    for (std::uint32_t page = 0; page < pages; page += std::min(pages - page, kPagesAtOnce)) {
        run_.recorder.dispatch(pipeline, "fiblet cull" + layer_.suffix, std::min(pages - page, kPagesAtOnce), 1, 1,
                               CullPush{own_.layerAddress(), numbers.address() + std::uint64_t{4} * page});
    }
    run_.recorder.submitAndWait();
}

void FibletCull::pyramid() {
    glm::ivec2 size(run_.target.width, run_.target.height);
    for (std::size_t level = 0; level < own_.level_offsets.size(); ++level) {
        const std::uint32_t source = level == 0 ? 0 : own_.level_offsets[level - 1];
        const glm::ivec2 half = (size + 1) / 2;
        run_.recorder.dispatch(run_.pipelines.get("fiblet_pyramid", {PassRun::kGroup, level == 0 ? 1U : 0U}),
                               "fiblet pyramid" + layer_.suffix,
                               PassRun::groups(static_cast<std::uint64_t>(half.x) * static_cast<std::uint64_t>(half.y)), 1, 1,
                               PyramidPush{own_.layerAddress(), source, own_.level_offsets[level], size});
        size = half;
    }
}

std::vector<std::uint32_t> FibletCull::foundPages(std::uint32_t phase, std::uint32_t first, std::uint32_t end) {
    findPages(phase, first, end, own_.found_page_numbers);
    std::vector<bool> found(scene_.pages().size());
    for (const std::uint32_t page : own_.found_page_numbers.as<std::uint32_t>().first(own_.counts().pages)) found[page] = true;
    std::vector<std::uint32_t> sorted;
    std::ranges::copy_if(std::span(own_.near_first).subspan(first, end - first), std::back_inserter(sorted),
                         [&](std::uint32_t page) { return found[page]; });
    return sorted;
}

void FibletCull::cullFound(std::uint32_t phase, std::span<const std::uint32_t> pages) {
    std::ranges::copy(pages, own_.shown_pages.as<std::uint32_t>().begin());
    cullPages(phase, own_.shown_pages, static_cast<std::uint32_t>(pages.size()));
}

void FibletCull::cullPaged(std::uint32_t phase, std::uint32_t first, std::uint32_t end, std::vector<std::uint32_t>& missing) {
    FibletResidency& residency = *scene_.residency();
    const std::vector<std::uint32_t> found = foundPages(phase, first, end);
    std::vector<std::uint32_t> taken;
    std::ranges::copy_if(found, std::back_inserter(taken), [&](std::uint32_t page) { return residency.take(page); });
    own_.pages_wanted += found.size();
    own_.pages_left_out += found.size() - taken.size();
    residency.fetch(run_.recorder, taken, run_.list.pages_until, run_.cancel);
    std::ranges::copy_if(taken, std::back_inserter(missing), [&](std::uint32_t page) { return !residency.resident(page); });
    cullFound(phase, found);
}

}  // namespace radiata::render
