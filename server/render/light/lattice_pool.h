// Device memory of an illumination lattice: texels in bricks of 4^3, a brick only where somebody looks, within a budget.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/buffer.h"
#include "gpu/fwd.h"
#include "gpu/recorder.h"

namespace radiata::render {

/// Bricks in slots of a pool that grows as needed. Slots of bricks that were wanted longest ago are given to others once the
/// budget is used up.
class LatticePool {
public:
    /// \param bricks         of the whole lattice
    /// \param payload_bytes  of one texel, a multiple of 4
    LatticePool(gpu::Device& device, std::uint64_t bricks, std::uint64_t payload_bytes, std::uint64_t budget_bytes);

    /// The next request's number; bricks that it wants get it into wanted().
    std::uint32_t beginRequest() { return ++request_; }
    /// After the device marked what the request wants: gives each such brick a slot. New texels are empty.
    /// \return bricks for which the budget had no room  \throws Error(kResourceExhausted) if the device has none
    std::uint64_t admit(gpu::CommandRecorder& recorder);
    /// Marks bricks [begin, end) as wanted by this request, in place of the device.
    void want(std::uint64_t begin, std::uint64_t end);
    /// Whether the budget has room for that many bricks.
    bool fits(std::uint64_t bricks) const { return bricks <= slots_max_; }
    /// Of a brick, plus one; 0: it has none.
    std::uint32_t slotOf(std::uint32_t brick) const { return slot_of_brick_[brick]; }
    /// Forgets all texels.
    void clear();

    std::uint64_t index() const { return index_.address(); }
    std::uint64_t wanted() const { return wanted_.address(); }
    const gpu::Buffer& state() const { return state_; }
    const gpu::Buffer& payload() const { return payload_; }
    const gpu::Buffer& shown() const { return shown_; }
    /// Of each slot: its brick.
    const gpu::Buffer& slotBricks() const { return slot_bricks_; }
    std::uint32_t slotsUsed() const { return static_cast<std::uint32_t>(slots_.size()); }
    std::uint64_t bytes() const;
    std::uint64_t payloadBytes() const { return payload_ ? payload_.sizeBytes() : 0; }
    /// Of one brick with everything that belongs to it.
    std::uint64_t brickBytes() const;

private:
    void grow(gpu::CommandRecorder& recorder, std::uint64_t slots);

    struct Slot {
        std::uint32_t brick;
        std::uint32_t wanted;  ///< number of the latest request
    };
    gpu::Device& device_;
    std::uint64_t bricks_, payload_bytes_, slots_max_;
    std::uint64_t capacity_ = 0;
    std::uint32_t request_ = 0;
    std::vector<std::uint32_t> slot_of_brick_;  ///< plus one; what index_ holds
    std::vector<Slot> slots_;
    gpu::Buffer index_, wanted_, slot_bricks_, state_, payload_, shown_;
};

}  // namespace radiata::render
