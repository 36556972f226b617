#include "render/light/lattice_pool.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "base/checked.h"
#include "gpu/device.h"
#include "shaders/shared/lattice.glsl"

namespace radiata::render {
namespace {

constexpr std::uint64_t kTexels = shader::TEXELS_PER_BRICK;
/// State, and what is shown.
constexpr std::uint64_t kOtherBytes = 4 + 8;

/// A larger buffer with the old one's content in front and zeros behind.
gpu::Buffer grown(gpu::Device& device, gpu::CommandRecorder& recorder, const gpu::Buffer& old, std::uint64_t bytes,
                  const char* name) {
    gpu::Buffer larger(device, bytes, gpu::Memory::kDevice, name);
    recorder.fill(larger, 0, bytes, 0);
    if (old) recorder.copy(old, 0, larger, 0, old.sizeBytes());
    recorder.submitAndWait();
    return larger;
}

}  // namespace

LatticePool::LatticePool(gpu::Device& device, std::uint64_t bricks, std::uint64_t payload_bytes, std::uint64_t budget_bytes)
    : device_(device), bricks_(bricks), payload_bytes_(payload_bytes) {
    slots_max_ = std::min(budget_bytes / brickBytes(), bricks);
    slot_of_brick_.assign(bricks, 0);
    const std::uint64_t bytes = checkedMultiply(bricks, 4, "bricks of an illumination lattice");
    index_ = gpu::Buffer(device, bytes, gpu::Memory::kDevice, "lattice index");
    wanted_ = gpu::Buffer(device, bytes, gpu::Memory::kReadback, "lattice bricks wanted");
    std::ranges::fill(wanted_.as<std::uint32_t>(), 0U);
    gpu::upload(device, index_, 0, std::as_bytes(std::span(slot_of_brick_)));
}

std::uint64_t LatticePool::brickBytes() const { return kTexels * (payload_bytes_ + kOtherBytes); }

std::uint64_t LatticePool::bytes() const { return capacity_ * brickBytes() + 2 * 4 * bricks_; }

void LatticePool::grow(gpu::CommandRecorder& recorder, std::uint64_t slots) {
    if (slots <= capacity_) return;
    // Memory counts for more than copies: a moving view copies all texels once for each eighth that is new.
    const std::uint64_t capacity = std::min(std::max(slots, capacity_ + capacity_ / 8), slots_max_);
    state_ = grown(device_, recorder, state_, capacity * kTexels * 4, "lattice states");
    shown_ = grown(device_, recorder, shown_, capacity * kTexels * 8, "lattice light");
    payload_ = grown(device_, recorder, payload_, capacity * kTexels * payload_bytes_, "lattice payloads");
    slot_bricks_ = gpu::Buffer(device_, capacity * 4, gpu::Memory::kUpload, "lattice slots");
    capacity_ = capacity;
}

std::uint64_t LatticePool::admit(gpu::CommandRecorder& recorder) {
    const std::span<std::uint32_t> wanted = wanted_.as<std::uint32_t>();
    std::vector<std::uint32_t> missing;
    for (std::uint32_t brick = 0; brick < bricks_; ++brick) {
        if (wanted[brick] != request_) continue;
        if (slot_of_brick_[brick] == 0) {
            missing.push_back(brick);
        } else {
            slots_[slot_of_brick_[brick] - 1].wanted = request_;
        }
    }
    if (missing.empty()) return 0;
    grow(recorder, std::min<std::uint64_t>(slots_.size() + missing.size(), slots_max_));
    // New slots first, then those that were wanted longest ago, but none that this request wants.
    std::vector<std::uint32_t> reused;
    if (slots_.size() + missing.size() > capacity_) {
        std::vector<std::uint32_t> by_age(slots_.size());
        std::iota(by_age.begin(), by_age.end(), 0U);
        std::ranges::stable_sort(by_age, {}, [&](std::uint32_t slot) { return slots_[slot].wanted; });
        for (const std::uint32_t slot : by_age) {
            if (slots_[slot].wanted != request_) reused.push_back(slot);
        }
    }
    // Neighbours were mostly wanted at the same time, so few runs of slots are emptied, not each alone.
    reused.resize(std::min(reused.size(), missing.size() - std::min(missing.size(), capacity_ - slots_.size())));
    std::ranges::sort(reused);
    for (std::size_t i = 0, last = 0; i < reused.size(); i = last) {
        for (last = i + 1; last < reused.size() && reused[last] == reused[i] + last - i;) ++last;
        recorder.fill(state_, reused[i] * kTexels * 4, (last - i) * kTexels * 4, 0);
        recorder.fill(shown_, reused[i] * kTexels * 8, (last - i) * kTexels * 8, 0);
    }
    std::size_t given = 0, next_reused = 0;
    for (; given < missing.size(); ++given) {
        std::uint32_t slot = 0;
        if (slots_.size() < capacity_) {
            slot = static_cast<std::uint32_t>(slots_.size());
            slots_.emplace_back();
        } else if (next_reused < reused.size()) {
            slot = reused[next_reused++];
            slot_of_brick_[slots_[slot].brick] = 0;
        } else {
            break;
        }
        slots_[slot] = {missing[given], request_};
        slot_of_brick_[missing[given]] = slot + 1;
    }
    recorder.submitAndWait();
    const std::span<std::uint32_t> bricks = slot_bricks_ ? slot_bricks_.as<std::uint32_t>() : std::span<std::uint32_t>{};
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) bricks[slot] = slots_[slot].brick;
    gpu::upload(device_, index_, 0, std::as_bytes(std::span(slot_of_brick_)));
    return missing.size() - given;
}

void LatticePool::want(std::uint64_t begin, std::uint64_t end) {
    std::ranges::fill(wanted_.as<std::uint32_t>().subspan(begin, end - begin), request_);
}

void LatticePool::clear() {
    slots_.clear();
    std::ranges::fill(slot_of_brick_, 0U);
    gpu::upload(device_, index_, 0, std::as_bytes(std::span(slot_of_brick_)));
    for (gpu::Buffer* buffer : {&state_, &payload_, &shown_, &slot_bricks_}) *buffer = gpu::Buffer();
    capacity_ = 0;
}

}  // namespace radiata::render
