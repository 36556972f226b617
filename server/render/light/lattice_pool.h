// Device memory of an illumination lattice: texels in bricks of 4^3, a brick only where somebody looks and, of its texels,
// light only for those that somebody needs, within a budget.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/buffer.h"
#include "gpu/fwd.h"
#include "gpu/recorder.h"

namespace radiata::render {

/// A brick has a slot: what is shown of each of its texels. A texel that was needed has a row besides: its state and payload.
/// Slots and rows come from pools that grow as needed; bricks that were wanted longest ago give way once the budget is used up.
/// Where all texels are wanted, bricks are kept whole: then a texel's place is its row and nothing says which row is whose.
class LatticePool {
public:
    /// \param bricks         of the whole lattice
    /// \param payload_bytes  of one texel, a multiple of 4
    LatticePool(gpu::Device& device, std::uint64_t bricks, std::uint64_t payload_bytes, std::uint64_t budget_bytes);

    /// Of a pool without texels: whether it keeps bricks whole.
    void keepWhole(bool whole);
    /// Keeps bricks whole from now on. \param move  copies states and payloads of all rows to where their places are in these
    /// buffers, and waits for it; is not called if there are no texels
    void makeWhole(gpu::CommandRecorder& recorder,
                   const std::function<void(const gpu::Buffer& state, const gpu::Buffer& payload)>& move);
    bool whole() const { return whole_; }

    /// Texels that the device sets in wanted() until admit() belong to this request.
    void beginRequest();
    /// Frees what is needed for that alone.
    void endRequest() { wanted_ = gpu::Buffer(); }
    /// After the device marked what the request wants: gives each brick a slot and each of its texels a row. New texels are
    /// empty, those that were there keep what they have.
    /// \return bricks for which, or for texels of which, the budget had no room
    /// \throws Error(kResourceExhausted) if the device has none
    std::uint64_t admit(gpu::CommandRecorder& recorder);
    /// Marks texels of bricks [begin, end) as wanted by this request, in place of the device. \param texels  bit i: texel i
    void want(std::uint64_t begin, std::uint64_t end, std::uint64_t texels = ~std::uint64_t{0});
    /// Whether the budget has room for all bricks, kept whole.
    bool fitsWhole() const { return bricks_ <= budget_bytes_ / wholeBrickBytes(); }
    /// Of one brick that is kept whole, with everything that belongs to it.
    std::uint64_t wholeBrickBytes() const;
    /// Of a brick, plus one; 0: it has none.
    std::uint32_t slotOf(std::uint32_t brick) const { return slot_of_brick_[brick]; }
    /// Of a texel, by its number in the brick. Takes a while: for tests.
    std::optional<std::uint64_t> rowOf(std::uint32_t brick, std::uint32_t texel) const;
    /// Forgets all texels.
    void clear();

    std::uint64_t index() const { return index_.address(); }
    std::uint64_t wanted() const { return wanted_ ? wanted_.address() : 0; }
    /// Of each row its place, slot * TEXELS_PER_BRICK + texel, or TEXEL_NOWHERE; 0 if it is its place.
    std::uint64_t places() const { return places_ ? places_.address() : 0; }
    const gpu::Buffer& state() const { return state_; }      ///< by row
    const gpu::Buffer& payload() const { return payload_; }  ///< by row
    const gpu::Buffer& shown() const { return shown_; }      ///< by place
    /// Of each slot: its brick.
    const gpu::Buffer& slotBricks() const { return slot_bricks_; }
    std::uint32_t slotsUsed() const { return static_cast<std::uint32_t>(slots_.size()); }
    /// The last row that is used, plus one.
    std::uint32_t rowsUsed() const;
    /// Of all buffers.
    std::uint64_t bytes() const;
    std::uint64_t payloadBytes() const { return payload_ ? payload_.sizeBytes() : 0; }

private:
    struct Slot {
        std::uint32_t brick = 0;
        std::uint32_t wanted = 0;  ///< number of the latest request
        std::uint64_t texels = 0;  ///< bit i: texel i has a row
    };
    struct Want {
        std::uint32_t brick;
        std::uint64_t texels;
    };
    struct Size {
        std::uint64_t slots = 0, rows = 0;
        bool operator==(const Size&) const = default;
    };
    std::uint64_t bytesOf(const Size& size) const;
    Size used() const;
    bool affords(const Size& size) const;
    bool fits(const Size& size) const;
    Size with(Size held, const Want& want) const;
    std::size_t leftOutByAnEmptyPool(const std::vector<Want>& wants) const;
    std::vector<Want> takeWanted();
    std::uint64_t admit(gpu::CommandRecorder& recorder, std::vector<Want> wants);
    void evict(Size& need);
    void grow(gpu::CommandRecorder& recorder, const Size& need);
    void give(gpu::CommandRecorder& recorder, const std::vector<Want>& wants);

    gpu::Device& device_;
    std::uint64_t bricks_, payload_bytes_, budget_bytes_;
    bool whole_ = false;
    Size capacity_;
    std::uint32_t request_ = 0;
    std::vector<std::uint32_t> slot_of_brick_;  ///< plus one; what index_ holds
    std::vector<Slot> slots_;
    std::vector<std::uint32_t> place_of_row_;            ///< what places_ holds; empty if bricks are kept whole
    std::vector<std::uint32_t> free_slots_, free_rows_;  ///< the last is taken first: descending
    gpu::Buffer index_, wanted_, slot_bricks_, places_, state_, payload_, shown_;
};

}  // namespace radiata::render
