// Fibres within an outline: a picture of the outline's window, or what is drawn through its pixels.
#include <algorithm>

#include "gpu/device.h"
#include "render/frame/fiblet_peel.h"
#include "render/frame/pick.h"

namespace radiata::render {
namespace {

/// One bit each, 32 to a word.
std::vector<std::uint32_t> wordsOf(const std::vector<bool>& bits) {
    std::vector<std::uint32_t> words((bits.size() + 31) / 32, 0);
    for (std::size_t i = 0; i < bits.size(); ++i) words[i / 32] |= bits[i] ? 1U << (i % 32) : 0U;
    return words;
}

std::vector<std::uint32_t> numbersOf(const std::vector<std::uint32_t>& words) {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < 32 * words.size(); ++i) {
        if ((words[i / 32] >> (i % 32) & 1U) != 0) numbers.push_back(i);
    }
    return numbers;
}

/// Bits of the fibres that win a pixel inside.
std::vector<std::uint32_t> seen(const std::vector<shader::Surface>& surfaces, const model::OutlinePixels& pixels,
                                std::size_t layer, const model::FibletSet& set) {
    std::vector<std::uint32_t> words((set.fibres() + 31) / 32, 0);
    for (std::size_t at = 0; at < surfaces.size(); ++at) {
        if (!pixels.inside[at] || surfaces[at].who == shader::FIBLET_NOBODY || surfaces[at].layer_and_steps >> 24U != layer)
            continue;
        const std::uint32_t fibre = set.heads[surfaces[at].who >> shader::FIBLET_SEGMENT_BITS].fibre;
        words[fibre / 32] |= 1U << (fibre % 32);
    }
    return words;
}

/// Bits of the fibres that are drawn through a pixel inside.
std::vector<std::uint32_t> passing(PassRun& run, const plan::PassPlan& pass, const model::OutlinePixels& pixels,
                                   std::uint64_t fibres) {
    std::vector<std::uint32_t> words((fibres + 31) / 32, 0);
    if (words.empty()) return words;
    const std::vector<std::uint32_t> mask = wordsOf(pixels.inside);
    gpu::Buffer inside(run.device, std::span(mask).size_bytes(), gpu::Memory::kDevice, "outline");
    gpu::upload(run.device, inside, 0, std::as_bytes(std::span(mask)));
    gpu::Buffer found(run.device, std::span(words).size_bytes(), gpu::Memory::kDevice, "fibres found");
    gpu::upload(run.device, found, 0, std::as_bytes(std::span(words)));
    runFibletsThrough(run, pass, inside.address(), found.address());
    gpu::download(run.device, found, 0, std::as_writable_bytes(std::span(words)));
    return words;
}

}  // namespace

std::vector<model::PickedFibres> pickOutline(gpu::Device& device, Drawer& drawer, Target::Impl& target, DrawList& list,
                                             const model::OutlinePixels& pixels, bool through) {
    const model::FrameRequest& picture = list.plan->resolved;
    std::vector<shader::Surface> surfaces;
    list.all_pages = true;
    if (pixels.size.x > 0) {
        const glm::dvec2 whole(picture.width, picture.height);
        list.pixel_offset = glm::vec2(glm::dvec2(pixels.first) + 0.5 * glm::dvec2(pixels.size) - 0.5 * whole);
        target.prepare(device, pixels.size.x, pixels.size.y, list.layers.size());
        drawer.drawSample(target, list, 0, nullptr);
        surfaces.resize(pixels.inside.size());
        gpu::download(device, target.surface, 0, std::as_writable_bytes(std::span(surfaces)));
    }
    std::vector<model::PickedFibres> picked;
    for (const plan::PassPlan& pass : list.plan->passes) {
        if (pass.kind != plan::PassKind::kFiblets) continue;
        const auto layer = static_cast<std::size_t>(pass.layer);
        const model::FibletSet& set = list.layers[layer].tracts->set();
        model::PickedFibres& fibres = picked.emplace_back();
        fibres.layer = pass.layer;
        fibres.dataset_id = picture.scene.layers[layer].datasetId();
        if (surfaces.empty()) continue;
        if (through) {
            PassRun run{device, drawer.recorder(), drawer.pipelines(), target, list};
            fibres.fibres = numbersOf(passing(run, pass, pixels, set.fibres()));
        } else {
            fibres.fibres = numbersOf(seen(surfaces, pixels, layer, set));
        }
    }
    drawer.takeTimings();
    return picked;
}

}  // namespace radiata::render
