// All texels of a lattice, part by part: sums and lists are needed for one part at a time. Source: Wyman et al. 2006, Table 1,
// "full" rows.
#include <algorithm>

#include <glm/gtc/packing.hpp>

#include "base/error.h"
#include "render/light/lattice.h"

namespace radiata::render {
namespace {

constexpr std::uint64_t kBricksPerPart = 65536 / shader::TEXELS_PER_BRICK;

}  // namespace

void IlluminationLattice::requestBricks(const LatticeRun& run, std::uint64_t begin, std::uint64_t end, std::uint64_t mark) {
    run.checkCancelled();
    if (!pool_.fitsWhole()) {
        throw Error(Code::kResourceExhausted, "the whole illumination lattice needs " +
                                                  std::to_string(brickCount() * pool_.wholeBrickBytes() / 1048576 + 1) +
                                                  " MiB, the budget is " +
                                                  std::to_string(static_cast<std::uint64_t>(light_.budget_mib)) + " MiB");
    }
    requested_for_ = 0;
    requested_.clear();
    active_.clear();
    run.recorder.submitAndWait();
    keepBricksWhole(run);
    pool_.beginRequest();
    pool_.want(begin, end);
    left_out_ = pool_.admit(run.recorder);
    refreshAddresses();
    constexpr std::uint64_t kBytes = std::uint64_t{shader::TEXELS_PER_BRICK} * 4;
    clearCoverage(run);
    // Neighbours mostly have neighbouring slots.
    for (std::uint64_t brick = begin, last = begin; brick < end; brick = last) {
        const std::uint64_t slot = pool_.slotOf(static_cast<std::uint32_t>(brick)) - 1;
        for (last = brick + 1; last < end && pool_.slotOf(static_cast<std::uint32_t>(last)) - 1 == slot + last - brick;) ++last;
        run.recorder.fill(coverage_, slot * kBytes, (last - brick) * kBytes, 1);
    }
    list(run);
    requested_for_ = mark;
}

void IlluminationLattice::keepBricksWhole(const LatticeRun& run) {
    struct Push {
        std::uint64_t lattice, state, payload;
        std::uint32_t rows, words;
    };
    pool_.makeWhole(run.recorder, [&](const gpu::Buffer& state, const gpu::Buffer& payload) {
        const std::uint32_t rows = pool_.rowsUsed();
        run.recorder.dispatch(
            run.pipeline("isosurface_spread_texels", {64U}), "illumination texels", (rows + 63) / 64, 1, 1,
            Push{params_.address(), state.address(), payload.address(), rows, static_cast<std::uint32_t>(payloadBytes() / 4)});
        run.recorder.submitAndWait();
    });
    refreshAddresses();
}

void IlluminationLattice::requestAll(const LatticeRun& run) { requestBricks(run, 0, brickCount(), 0); }

void IlluminationLattice::noteWhole(std::uint32_t state) {
    whole_.done += isDone(state);
    whole_.out_of_samples += isDone(state) && !isExact(state);
    if (texelSamples(state) == 0) return;
    whole_.errors.resize(65536);
    ++whole_.errors[state & 0xffffU];
}

bool IlluminationLattice::lightAll(const LatticeRun& run, std::optional<std::chrono::steady_clock::time_point> until) {
    while (!whole()) {
        const std::uint64_t mark = kWholeMark | whole_.next_brick;
        const std::uint64_t end = std::min(whole_.next_brick + kBricksPerPart, brickCount());
        if (requested_for_ != mark) requestBricks(run, whole_.next_brick, end, mark);
        if (!refine(run, until)) return false;
        for (const Texel& texel : requested_) noteWhole(texel.item.state);
        whole_.samples += samples_;
        whole_.seconds += seconds_;
        samples_ = 0;
        seconds_ = 0;
        whole_.next_brick = end;
    }
    return true;
}

/// What is known of all texels so far, in place of those of one picture.
model::IlluminationInfo IlluminationLattice::wholeInfo(model::IlluminationInfo info) const {
    info.texels_needed = info.texels;
    info.texels_done = whole_.done;
    info.texels_out_of_samples = whole_.out_of_samples;
    info.samples += whole_.samples;
    info.seconds += whole_.seconds;
    if (requestedWhole() && !whole()) {
        for (const Texel& texel : requested_) {
            info.texels_done += isDone(texel.item.state);
            info.texels_out_of_samples += isDone(texel.item.state) && !isExact(texel.item.state);
        }
    }
    std::uint64_t known = 0, below = 0;
    for (std::size_t bits = 0; bits < whole_.errors.size(); ++bits) {
        if (whole_.errors[bits] == 0) continue;  // not all bits are numbers
        known += whole_.errors[bits];
        info.mean_error += static_cast<double>(whole_.errors[bits]) * texelError(static_cast<std::uint32_t>(bits));
    }
    if (known == 0) return info;
    info.mean_error /= static_cast<double>(known);
    // Positive halves are ordered as their bits are.
    for (std::size_t bits = 0; bits < whole_.errors.size() && below < (known * 95 + 99) / 100; ++bits) {
        below += whole_.errors[bits];
        info.p95_error = texelError(static_cast<std::uint32_t>(bits));
    }
    return info;
}

}  // namespace radiata::render
