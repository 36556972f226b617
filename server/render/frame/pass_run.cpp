#include "render/frame/pass_run.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "base/error.h"

namespace radiata::render {

std::uint64_t PassRun::layerAddress(std::size_t layer) const {
    return target.params.address() + Target::Impl::kLayerOffset + layer * sizeof(shader::GlyphLayerParams);
}

void PassRun::checkCancelled() const {
    if (cancel != nullptr && cancel->load()) throw Error(Code::kCancelled, "the picture is no longer wanted");
}

std::uint32_t PassRun::bandRows(const BandSize& size, std::uint32_t left) {
    return std::clamp(static_cast<std::uint32_t>(size.block_rows), 1U, left);
}

std::uint32_t PassRun::rowRuns() {
    static const std::uint32_t runs = std::clamp(std::thread::hardware_concurrency(), 1U, 16U);
    return runs;
}

void PassRun::submitBand(BandSize& size, std::uint32_t rows) const {
    const auto begin = std::chrono::steady_clock::now();
    recorder.submitAndWait();
    const double took_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    size.block_rows = std::clamp(rows * std::clamp(BandSize::kSubmissionMs / std::max(took_ms, 0.01), 0.25, 4.0), 1.0, 1e6);
}

}  // namespace radiata::render
