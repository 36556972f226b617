#include "render/fiblet/fiblet_scene.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <string>

#include "base/error.h"
#include "gpu/device.h"

namespace radiata::render {
namespace {

/// Fiblet and segment share 32 bits of a pixel's word; the last number is nobody.
constexpr std::uint64_t kFibletsMax = (std::uint64_t{1} << (32 - shader::FIBLET_SEGMENT_BITS)) - 1;

template <typename T>
gpu::Buffer uploaded(gpu::Device& device, const std::vector<T>& values, const char* name) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
    gpu::Buffer buffer(device, std::max<std::size_t>(bytes.size(), 4), gpu::Memory::kDevice, name);
    if (!bytes.empty()) gpu::upload(device, buffer, 0, bytes);
    return buffer;
}

}  // namespace

FibletScene::FibletScene(gpu::Device& device, std::shared_ptr<const model::FibletSet> set, std::uint64_t budget_bytes)
    : set_(std::move(set)) {
    static std::atomic<std::uint64_t> next_serial{1};
    serial_ = next_serial++;
    if (set_->heads.size() > kFibletsMax) {
        throw Error(Code::kUnsupported, set_->source + " has " + std::to_string(set_->heads.size()) + " fiblets; at most " +
                                            std::to_string(kFibletsMax) + " can be drawn in one layer, so split it");
    }
    pages_ = uploaded(device, set_->pages, "fiblet pages");
    if (budget_bytes > 0 && FibletResidency::wholeBytes(*set_) > budget_bytes) {
        residency_ = std::make_unique<FibletResidency>(device, set_, budget_bytes);
    } else {
        heads_ = uploaded(device, set_->heads, "fiblet heads");
        codes_ = uploaded(device, set_->codes, "fiblet codes");
        boxes_ = uploaded(device, set_->boxes, "fiblet boxes");
    }
    bounds_ = {set_->origin_mm, set_->origin_mm};
    if (set_->pages.empty()) return;
    glm::vec3 low(std::numeric_limits<float>::infinity()), high = -low;
    for (const shader::FibletPage& page : set_->pages) {
        low = glm::min(low, page.low);
        high = glm::max(high, page.high);
    }
    bounds_ = {set_->origin_mm + glm::dvec3(low), set_->origin_mm + glm::dvec3(high)};
    reach_mm_ = glm::length(glm::max(glm::abs(glm::dvec3(low)), glm::abs(glm::dvec3(high))));
}

std::uint64_t FibletScene::deviceBytes() const {
    if (residency_) return residency_->deviceBytes() + pages_.sizeBytes();
    return heads_.sizeBytes() + codes_.sizeBytes() + pages_.sizeBytes() + boxes_.sizeBytes();
}

}  // namespace radiata::render
