// Finds the fiblets of one layer that can be seen: pages first, then what is in them (shaders/fiblet/cull.comp). Of a
// tractogram beyond the memory budget, pages that can be seen are what is wanted from the disk.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "render/frame/fiblet_run.h"

namespace radiata::render {

class FibletCull {
public:
    explicit FibletCull(FibletRun& layer)
        : layer_(layer), run_(layer.run), plan_(layer.plan), scene_(layer.scene), own_(layer.own) {}

    /// Adds what a phase leaves of some pages in their order to the list.
    void cull(std::uint32_t phase, std::uint32_t first, std::uint32_t end);
    /// Farthest depths under squares of pixels, by what was drawn so far.
    void pyramid();
    /// Calls draw(first, end) for pages in their order, each time with a new pyramid.
    template <typename Draw>
    void inParts(std::uint32_t pages, Draw&& draw) {
        std::uint32_t first = 0;
        for (const double part : kParts) {
            const auto end = static_cast<std::uint32_t>(std::ceil(part * pages));
            if (part < 1 && end - first <= run_.pixels() / kPixelsPerPage) continue;
            run_.checkCancelled();
            pyramid();
            draw(first, end);
            first = end;
        }
    }

    /// Of a scene that is not all on the device: pages of which something can be seen, nearest first.
    std::vector<std::uint32_t> foundPages(std::uint32_t phase, std::uint32_t first, std::uint32_t end);
    /// Adds what a phase leaves of such pages to the list, as far as it is on the device.
    void cullFound(std::uint32_t phase, std::span<const std::uint32_t> pages);
    /// Both, and in between has the pages brought to the device, as long as the draw list says. Those that have room and did
    /// not come are added to `missing`.
    void cullPaged(std::uint32_t phase, std::uint32_t first, std::uint32_t end, std::vector<std::uint32_t>& missing);

private:
    /// Shares of the pages, nearest first, before each of which the second phase looks at the depths anew: what is in front
    /// must be drawn before it can hide anything. Those seen last do not spare that: the camera moves, and through the gaps
    /// that it finds between them all pages would be seen.
    static constexpr std::array<double, 9> kParts{1.0 / 32, 1.0 / 16, 1.0 / 8, 3.0 / 16, 1.0 / 4,
                                                  3.0 / 8,  1.0 / 2,  3.0 / 4, 1.0};
    /// A new pyramid takes about as long as drawing a page for so many pixels.
    static constexpr std::uint64_t kPixelsPerPage = 4096;

    std::uint32_t margin() const;
    void findPages(std::uint32_t phase, std::uint32_t first, std::uint32_t end, const gpu::Buffer& into);
    void cullPages(std::uint32_t phase, const gpu::Buffer& numbers, std::uint32_t pages);

    FibletRun& layer_;
    PassRun& run_;
    const plan::FibletPlan& plan_;
    const FibletScene& scene_;
    FibletBuffers& own_;
};

}  // namespace radiata::render
