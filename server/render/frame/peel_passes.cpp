#include "render/frame/peel_passes.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "gpu/device.h"
#include "plan/plan_peels.h"
#include "render/frame/fiblet_peel.h"
#include "render/frame/isosurface_passes.h"
#include "render/frame/light_passes.h"
#include "shaders/shared/peel.glsl"

namespace radiata::render {
namespace {

/// Surfaces per pixel that a moving picture composes.
constexpr std::uint32_t kMovingPeels = 4;
/// Segments that a pixel keeps of a layer at rest, where memory suffices.
constexpr std::uint32_t kRestingSlots = 8;

struct BeginPush {
    std::uint64_t peel, opaque, found, looks;
    std::uint32_t pixels, padding = 0;
};

class PeelRun {
public:
    PeelRun(PassRun& run, FibletPace& pace, BandSize& bands) : run_(run), bands_(bands), fast_(run.list.moving) {
        const std::uint64_t pixels = run.pixels();
        Target::Impl& target = run.target;
        ensureBytes(run.device, target.veil, pixels * sizeof(glm::vec4), gpu::Memory::kDevice, "veil");
        ensureBytes(run.device, target.peel_surface, pixels * sizeof(shader::Surface), gpu::Memory::kDevice, "peel surface");
        ensureBytes(run.device, target.peel_params, sizeof(shader::PeelParams), gpu::Memory::kUpload, "peel parameters");
        params() = {};
        const std::vector<model::Layer>& layers = run.list.plan->resolved.scene.layers;
        const bool alone = std::popcount(run.list.plan->peeled_layers) == 1;
        const auto lets_through = [](const model::Layer& layer) { return layer.ifTracts() && layer.opacity < 1; };
        const auto fibre_layers = static_cast<std::uint64_t>(std::ranges::count_if(layers, lets_through));
        const std::uint32_t slots = plan::peelSlots(pixels, fibre_layers, fast_ ? kMovingPeels : kRestingSlots);
        for (std::size_t i = 0; i < layers.size(); ++i) {
            if ((run.list.plan->peeled_layers >> i & 1U) == 0) continue;
            if (layers[i].ifTracts()) {
                fibres_.emplace_back(run, i, pace, alone, slots, fast_);
                alone_ = alone;
                params().fibres[i] = fibres_.back().address();
            } else if (layers[i].ifGlyphs()) {
                params().glyphs[i] = peelGlyphs(run, i).address();
                glyphs_ |= 1U << i;
            } else {
                surfaces_ |= 1U << i;
            }
            kinds_ |= 1U << layers[i].content.index();
        }
        placeCrossings(pixels);
        if (!fast_) return;
        ensureBytes(run.device, target.peel_rest, 4 * pixels, gpu::Memory::kDevice, "let through by peels");
        params().rest = target.peel_rest.address();
    }

    void draw() {
        run_.target.approximate = fast_;
        for (std::uint32_t round = 0; !fast_ || round < kMovingPeels; ++round) {
            run_.checkCancelled();
            // One layer of fibres writes all of the peel surface itself.
            if (!alone_ || (fast_ && round == 0)) begin(round == 0);
            if (surfaces_ != 0) findCrossings(round == 0);
            for (FibletPeel& layer : fibres_) layer.find(round);
            params().more = 0;
            runPeelLight(run_, run_.target.peel_params.address(), kinds_, round == 0, fast_ && round + 1 == kMovingPeels);
            run_.recorder.submitAndWait();
            if (params().more == 0) break;
        }
    }

private:
    shader::PeelParams& params() { return run_.target.peel_params.as<shader::PeelParams>()[0]; }

    void placeCrossings(std::uint64_t pixels) {
        std::uint64_t bytes = 0;
        for (std::uint32_t i = 0; i < 8; ++i) bytes += (surfaces_ >> i & 1U) * 4 * pixels;
        if (bytes == 0) return;
        ensureBytes(run_.device, run_.target.peel_crossings, bytes, gpu::Memory::kDevice, "crossings that were composed");
        std::uint64_t at = run_.target.peel_crossings.address();
        for (std::uint32_t i = 0; i < 8; ++i) {
            if ((surfaces_ >> i & 1U) == 0) continue;
            params().crossings[i] = at;
            at += 4 * pixels;
        }
    }

    void begin(bool first) {
        run_.recorder.dispatch(
            run_.pipelines.get("peel_begin", {PassRun::kGroup, first ? 1U : 0U, glyphs_, surfaces_, first && fast_ ? 1U : 0U}),
            "peel begin", PassRun::groups(run_.pixels()), 1, 1,
            BeginPush{run_.target.peel_params.address(), run_.target.surface.address(), run_.target.peel_surface.address(),
                      run_.frameAddress() + Target::Impl::kLookOffset, static_cast<std::uint32_t>(run_.pixels())});
    }

    void findCrossings(bool first) {
        runIsosurfacePeel(run_, surfaces_, run_.target.peel_params.address(), first && fast_, bands_);
    }

    PassRun& run_;
    BandSize& bands_;
    bool fast_, alone_ = false;
    std::vector<FibletPeel> fibres_;
    std::uint32_t glyphs_ = 0, surfaces_ = 0, kinds_ = 0;
};

}  // namespace

gpu::Buffer& peelGlyphs(PassRun& run, std::size_t layer) {
    std::vector<gpu::Buffer>& all = run.target.peel_glyphs;
    if (all.size() <= layer) all.resize(layer + 1);
    ensureBytes(run.device, all[layer], run.target.surface.sizeBytes(), gpu::Memory::kDevice, "transparent glyphs");
    return all[layer];
}

void runPeels(PassRun& run, const plan::PassPlan&, FibletPace& pace, BandSize& bands) { PeelRun(run, pace, bands).draw(); }

}  // namespace radiata::render
