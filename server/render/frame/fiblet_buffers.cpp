#include "render/frame/fiblet_buffers.h"

#include <algorithm>
#include <ranges>
#include <utility>

#include "gpu/device.h"
#include "render/frame/fiblet_coverage.h"
#include "render/frame/target.h"

namespace radiata::render {
namespace {

/// Levels of the pyramid up to the one of a single entry, and where each begins.
std::vector<std::uint32_t> levelOffsets(glm::ivec2 size, std::uint32_t& words) {
    std::vector<std::uint32_t> offsets;
    words = 0;
    while (size.x > 1 || size.y > 1) {
        size = (size + 1) / 2;
        offsets.push_back(words);
        words += static_cast<std::uint32_t>(size.x * size.y);
    }
    return offsets;
}

std::vector<std::uint32_t> nextFiblets(const model::FibletSet& set) {
    std::vector<std::uint32_t> next(std::max<std::size_t>(set.heads.size(), 1), shader::FIBLET_NOBODY);
    for (std::size_t fibre = 0; fibre < set.fibres(); ++fibre) {
        for (std::uint32_t i = set.fibre_first[fibre]; i + 1 < set.fibre_first[fibre + 1]; ++i) {
            next[set.fibre_fiblets[i]] = set.fibre_fiblets[i + 1];
        }
    }
    return next;
}

}  // namespace

FibletBuffers::FibletBuffers() = default;
FibletBuffers::~FibletBuffers() = default;

void FibletBuffers::prepare(gpu::Device& device, const FibletScene& scene, const glm::ivec2& size, bool culled, bool ends) {
    static_assert(sizeof(shader::FibletLayerParams) <= kCountsOffset);
    const std::uint64_t pixels = static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
    const std::uint64_t fiblets = std::max<std::uint64_t>(scene.fibletCount(), 1);
    ensureBytes(device, params, kCountsOffset + sizeof(shader::FibletCounts), gpu::Memory::kUpload, "fiblet parameters");
    ensureBytes(device, words, 8 * pixels, gpu::Memory::kDevice, "fiblet words");
    ensureBytes(device, tangents, 8 * pixels, gpu::Memory::kDevice, "fiblet tangents");
    const std::uint64_t listed = scene.residency() ? scene.residency()->fibletsMax() : fiblets;
    ensureBytes(device, list, 4 * std::max(culled ? listed : 0, pixels), gpu::Memory::kDevice, "fiblet list");
    if (scene_serial != scene.serial()) knows_visible = false;
    scene_serial = scene.serial();
    if (!ends) next = gpu::Buffer();
    if (ends && (!next || next_serial_ != scene.serial())) {
        const std::vector<std::uint32_t> indices = nextFiblets(scene.set());
        ensureBytes(device, next, 4 * indices.size(), gpu::Memory::kDevice, "next fiblets");
        gpu::upload(device, next, 0, std::as_bytes(std::span(indices)));
        next_serial_ = scene.serial();
    }
    if (!culled) return;
    ensureBytes(device, page_order, 4 * std::max<std::uint64_t>(scene.pages().size(), 1), gpu::Memory::kUpload,
                "fiblet page order");
    const std::uint64_t page_bytes = 4 * std::max<std::uint64_t>(scene.pages().size(), 1);
    if (scene.residency()) {
        ensureBytes(device, found_page_numbers, page_bytes, gpu::Memory::kReadback, "found pages, read back");
        ensureBytes(device, shown_pages, page_bytes, gpu::Memory::kUpload, "shown pages");
    } else {
        ensureBytes(device, visible, 4 * ((fiblets + 31) / 32), gpu::Memory::kDevice, "visible fiblets");
        ensureBytes(device, found_pages, page_bytes, gpu::Memory::kDevice, "found pages");
    }
    if (size != size_) {
        std::uint32_t pyramid_words = 0;
        level_offsets = levelOffsets(size, pyramid_words);
        ensureBytes(device, pyramid, 4 * std::uint64_t{std::max(pyramid_words, 1U)}, gpu::Memory::kDevice, "depth pyramid");
        size_ = size;
    }
}

void FibletBuffers::preparePeels(gpu::Device& device, std::uint64_t pixels, std::uint32_t slots, bool counted) {
    ensureBytes(device, peeled, 8 * pixels, gpu::Memory::kDevice, "peeled words");
    ensureBytes(device, chain, sizeof(shader::ChainSlot) * pixels * slots, gpu::Memory::kDevice, "chains of fibres");
    ensureBytes(device, limits, 4 * pixels, gpu::Memory::kDevice, "limits of chains");
    layer().peeled = peeled.address();
    layer().chain = chain.address();
    layer().limits = limits.address();
    if (!counted) return;
    ensureBytes(device, fragments, 4 * pixels, gpu::Memory::kDevice, "fragments");
    layer().fragments = fragments.address();
}

void FibletBuffers::fill(const FibletScene& scene, const shader::FibletView& view, std::span<const shader::FibletCut> cuts,
                         std::uint64_t states, std::uint32_t layer_index) {
    shader::FibletLayerParams& layer = this->layer();
    layer = {};
    layer.view = view;
    std::ranges::copy(cuts, layer.cuts);
    layer.codec = scene.set().codec;
    layer.heads = scene.headAddress();
    layer.pages = scene.pageAddress();
    layer.codes = scene.codeAddress();
    layer.boxes = scene.boxAddress();
    layer.states = states;
    layer.words = words.address();
    layer.tangents = tangents.address();
    layer.list = list.address();
    layer.list_size = static_cast<std::uint32_t>(std::min<std::uint64_t>(list.sizeBytes() / 4, 0xffffffffU));
    if (visible) layer.visible = visible.address();
    if (page_order) layer.page_order = page_order.address();
    if (pyramid) layer.pyramid = pyramid.address();
    if (next) layer.next = next.address();
    layer.places = scene.placeAddress();
    layer.counts = params.address() + kCountsOffset;
    layer.fiblet_count = static_cast<std::uint32_t>(scene.fibletCount());
    layer.page_count = static_cast<std::uint32_t>(scene.pages().size());
    layer.layer = layer_index;
    layer.pyramid_levels = static_cast<std::uint32_t>(level_offsets.size());
    counts() = {};
}

std::uint32_t FibletBuffers::orderPages(const FibletScene& scene) {
    const std::vector<shader::FibletPage>& boxes = scene.pages();
    const glm::vec3 forward = layer().view.forward;
    std::vector<std::pair<float, std::uint32_t>> order(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const glm::vec3 middle = 0.5F * (boxes[i].low + boxes[i].high), reach = boxes[i].high - middle;
        order[i] = {glm::dot(forward, middle) - glm::dot(glm::abs(forward), reach), static_cast<std::uint32_t>(i)};
    }
    std::ranges::sort(order);
    std::ranges::copy(std::views::values(order), page_order.as<std::uint32_t>().begin());
    if (scene.residency()) near_first.assign(std::views::values(order).begin(), std::views::values(order).end());
    return static_cast<std::uint32_t>(order.size());
}

}  // namespace radiata::render
