#include "render/frame/fiblet_cut.h"

#include <algorithm>
#include <chrono>

#include "gpu/device.h"
#include "render/frame/target.h"

namespace radiata::render {
namespace {

/// Triangles of the first dispatch and, where these take little time, of later ones; every device takes 65,535 workgroups.
constexpr std::uint32_t kFirstTriangles = 256, kTrianglesAtOnce = 16'384;
/// A dispatch is to take about this long, so that cancelled frames end soon.
constexpr std::chrono::milliseconds kDispatch(15);

struct CutPush {
    std::uint64_t layer, corners;
    std::uint32_t first, padding = 0;
};

}  // namespace

void findCutDepths(PassRun& run, const FibreFilter& filter, FibletBuffers& own, const std::string& suffix) {
    const std::uint64_t bytes = 4 * run.pixels();
    ensureBytes(run.device, own.cut_front, bytes, gpu::Memory::kDevice, "front of the cut");
    ensureBytes(run.device, own.cut_back, bytes, gpu::Memory::kDevice, "back of the cut");
    own.layer().cut_front = own.cut_front.address();
    own.layer().cut_back = own.cut_back.address();
    run.recorder.fill(own.cut_front, 0, bytes, shader::FIBLET_NOBODY);
    run.recorder.fill(own.cut_back, 0, bytes, 0);
    const gpu::ComputePipeline& pipeline = run.pipelines.get("fiblet_cut_depths", {PassRun::kGroup});
    std::uint32_t at_once = kFirstTriangles, count = 0;
    for (std::uint32_t first = 0; first < filter.cutTriangleCount(); first += count) {
        run.checkCancelled();
        count = std::min(filter.cutTriangleCount() - first, at_once);
        run.recorder.dispatch(pipeline, "fiblet cut" + suffix, count, 1, 1,
                              CutPush{own.layerAddress(), filter.cutTriangles(), first});
        const auto start = std::chrono::steady_clock::now();
        run.recorder.submitAndWait();
        const auto took = std::chrono::steady_clock::now() - start;
        at_once = took < kDispatch ? std::min(2 * at_once, kTrianglesAtOnce) : std::max(at_once / 2, 1U);
    }
}

}  // namespace radiata::render
