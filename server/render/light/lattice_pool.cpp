#include "render/light/lattice_pool.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <span>

#include "base/checked.h"
#include "base/error.h"
#include "gpu/device.h"
#include "shaders/shared/lattice.glsl"

namespace radiata::render {
namespace {

constexpr std::uint64_t kTexels = shader::TEXELS_PER_BRICK;
static_assert(kTexels == 64, "texels of a brick are the bits of a word");
constexpr std::uint64_t kSlotBytes = kTexels * 8 + 4;  ///< what is shown, and the slot's brick
constexpr std::uint64_t kStateBytes = 4, kPlaceBytes = 4;

gpu::Buffer zeros(gpu::Device& device, gpu::CommandRecorder& recorder, std::uint64_t bytes, const char* name) {
    gpu::Buffer buffer(device, bytes, gpu::Memory::kDevice, name);
    recorder.fill(buffer, 0, bytes, 0);
    return buffer;
}

/// Makes a buffer larger: what it holds in front, zeros behind.
void enlarge(gpu::Device& device, gpu::CommandRecorder& recorder, gpu::Buffer& buffer, std::uint64_t bytes, const char* name) {
    if (buffer.sizeBytes() >= bytes) return;
    gpu::Buffer larger = zeros(device, recorder, bytes, name);
    if (buffer) recorder.copy(buffer, 0, larger, 0, buffer.sizeBytes());
    recorder.submitAndWait();
    buffer = std::move(larger);
}

/// Zeroes elements by their ascending numbers. Neighbours were mostly wanted at the same time, so they are few runs.
void clearRuns(gpu::CommandRecorder& recorder, const gpu::Buffer& buffer, std::span<const std::uint32_t> numbers,
               std::uint64_t bytes) {
    for (std::size_t i = 0, last = 0; i < numbers.size(); i = last) {
        for (last = i + 1; last < numbers.size() && numbers[last] == numbers[i] + last - i;) ++last;
        recorder.fill(buffer, numbers[i] * bytes, (last - i) * bytes, 0);
    }
}

std::uint64_t bits(std::uint64_t texels) { return static_cast<std::uint64_t>(std::popcount(texels)); }

}  // namespace

LatticePool::LatticePool(gpu::Device& device, std::uint64_t bricks, std::uint64_t payload_bytes, std::uint64_t budget_bytes)
    : device_(device), bricks_(bricks), payload_bytes_(payload_bytes), budget_bytes_(budget_bytes) {
    slot_of_brick_.assign(bricks, 0);
    index_ = gpu::Buffer(device, checkedMultiply(bricks, 4, "bricks of an illumination lattice"), gpu::Memory::kDevice,
                         "lattice index");
    gpu::upload(device, index_, 0, std::as_bytes(std::span(slot_of_brick_)));
}

std::uint64_t LatticePool::wholeBrickBytes() const { return kSlotBytes + kTexels * (payload_bytes_ + kStateBytes); }

std::uint64_t LatticePool::bytesOf(const Size& size) const {
    return size.slots * kSlotBytes + size.rows * (payload_bytes_ + kStateBytes + (whole_ ? 0 : kPlaceBytes));
}

std::uint64_t LatticePool::bytes() const {
    std::uint64_t sum = 0;
    for (const gpu::Buffer* buffer : {&index_, &wanted_, &slot_bricks_, &places_, &state_, &payload_, &shown_}) {
        sum += buffer->sizeBytes();
    }
    return sum;
}

LatticePool::Size LatticePool::used() const {
    const std::uint64_t slots = slots_.size() - free_slots_.size();
    return {slots, whole_ ? kTexels * slots : place_of_row_.size() - free_rows_.size()};
}

std::uint32_t LatticePool::rowsUsed() const {
    return static_cast<std::uint32_t>(whole_ ? kTexels * slots_.size() : place_of_row_.size());
}

/// A budget that holds no whole brick holds nothing: with one, any brick can be there.
bool LatticePool::affords(const Size& size) const {
    return bytesOf({1, kTexels}) <= budget_bytes_ && bytesOf(size) <= budget_bytes_;
}

/// Whether the budget has room for that many beside what the pools have, which is not given back.
bool LatticePool::fits(const Size& size) const {
    return affords({std::max(size.slots, capacity_.slots), std::max(size.rows, capacity_.rows)});
}

LatticePool::Size LatticePool::with(Size held, const Want& want) const {
    const std::uint32_t slot = slot_of_brick_[want.brick];
    return {held.slots + (slot == 0 ? 1 : 0), held.rows + bits(want.texels & ~(slot == 0 ? 0 : slots_[slot - 1].texels))};
}

void LatticePool::beginRequest() {
    ++request_;
    if (wanted_) return;
    wanted_ = gpu::Buffer(device_, checkedMultiply(bricks_, 8, "bricks of an illumination lattice"), gpu::Memory::kReadback,
                          "lattice texels wanted");
    std::ranges::fill(wanted_.as<std::uint64_t>(), 0U);
}

void LatticePool::want(std::uint64_t begin, std::uint64_t end, std::uint64_t texels) {
    std::ranges::fill(wanted_.as<std::uint64_t>().subspan(begin, end - begin), texels);
}

/// The bricks that the request wants, ascending; those that are there are wanted latest now.
std::vector<LatticePool::Want> LatticePool::takeWanted() {
    std::vector<Want> wants;
    const std::span<std::uint64_t> wanted = wanted_.as<std::uint64_t>();
    for (std::uint32_t brick = 0; brick < bricks_; ++brick) {
        if (wanted[brick] == 0) continue;
        wants.push_back({brick, whole_ ? ~std::uint64_t{0} : wanted[brick]});
        wanted[brick] = 0;
        if (slot_of_brick_[brick] != 0) slots_[slot_of_brick_[brick] - 1].wanted = request_;
    }
    return wants;
}

std::uint64_t LatticePool::admit(gpu::CommandRecorder& recorder) { return admit(recorder, takeWanted()); }

std::uint64_t LatticePool::admit(gpu::CommandRecorder& recorder, std::vector<Want> wants) {
    Size need = used();
    for (const Want& want : wants) need = with(need, want);
    if (need == used()) return 0;
    if (!fits(need)) evict(need);
    std::size_t left_out = 0;
    if (!fits(need)) {
        const std::size_t left_out_at_best = leftOutByAnEmptyPool(wants);
        std::vector<Want> room;
        need = used();
        for (const Want& want : wants) {
            const Size more = with(need, want);
            if (!(more == need) && !fits(more)) continue;
            need = more;
            room.push_back(want);
        }
        left_out = wants.size() - room.size();
        // Pools that once grew for another kind of picture have their share of the budget for good: then all begins anew.
        if (left_out > left_out_at_best + wants.size() / 8) {
            clear();
            return admit(recorder, std::move(wants));
        }
        wants = std::move(room);
    }
    grow(recorder, need);
    give(recorder, wants);
    return left_out;
}

std::size_t LatticePool::leftOutByAnEmptyPool(const std::vector<Want>& wants) const {
    Size held;
    std::size_t left_out = 0;
    for (const Want& want : wants) {
        const Size more{held.slots + 1, held.rows + bits(want.texels)};
        if (!affords(more)) {
            ++left_out;
            continue;
        }
        held = more;
    }
    return left_out;
}

/// Those that were wanted longest ago go first, but none that this request wants, until what is needed fits.
void LatticePool::evict(Size& need) {
    std::vector<std::uint32_t> by_age;
    for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) {
        if (slots_[slot].texels != 0 && slots_[slot].wanted != request_) by_age.push_back(slot);
    }
    std::ranges::stable_sort(by_age, {}, [&](std::uint32_t slot) { return slots_[slot].wanted; });
    std::vector<bool> gone(slots_.size(), false);
    for (const std::uint32_t slot : by_age) {
        if (fits(need)) break;
        need = {need.slots - 1, need.rows - bits(slots_[slot].texels)};
        slot_of_brick_[slots_[slot].brick] = 0;
        slots_[slot] = {};
        free_slots_.push_back(slot);
        gone[slot] = true;
    }
    for (std::uint32_t row = 0; row < place_of_row_.size(); ++row) {
        if (place_of_row_[row] == shader::TEXEL_NOWHERE || !gone[place_of_row_[row] / kTexels]) continue;
        place_of_row_[row] = places_.as<std::uint32_t>()[row] = shader::TEXEL_NOWHERE;
        free_rows_.push_back(row);
    }
    std::ranges::sort(free_slots_, std::ranges::greater());
    std::ranges::sort(free_rows_, std::ranges::greater());
}

void LatticePool::grow(gpu::CommandRecorder& recorder, const Size& need) {
    // Memory counts for more than copies: a moving view copies all texels once for each eighth that is new.
    const auto larger = [](std::uint64_t needed, std::uint64_t capacity, std::uint64_t most) {
        return needed <= capacity ? capacity : std::min(std::max(needed, capacity + capacity / 8), most);
    };
    Size to{larger(need.slots, capacity_.slots, bricks_), larger(need.rows, capacity_.rows, kTexels * bricks_)};
    if (whole_) to.rows = kTexels * to.slots;
    if (!affords(to)) {
        to = {std::max(need.slots, capacity_.slots), std::max(need.rows, capacity_.rows)};
    }
    if (to.slots > capacity_.slots) {
        enlarge(device_, recorder, shown_, to.slots * kTexels * 8, "lattice light");
        slot_bricks_ = gpu::Buffer(device_, to.slots * 4, gpu::Memory::kUpload, "lattice slots");
        const std::span<std::uint32_t> bricks = slot_bricks_.as<std::uint32_t>();
        for (std::size_t slot = 0; slot < slots_.size(); ++slot) bricks[slot] = slots_[slot].brick;
    }
    if (to.rows > capacity_.rows) {
        enlarge(device_, recorder, state_, to.rows * kStateBytes, "lattice states");
        enlarge(device_, recorder, payload_, to.rows * payload_bytes_, "lattice payloads");
        if (!whole_) {
            places_ = gpu::Buffer(device_, to.rows * kPlaceBytes, gpu::Memory::kUpload, "lattice places");
            std::ranges::copy(place_of_row_, places_.as<std::uint32_t>().begin());
        }
    }
    capacity_ = to;
}

/// Slots and rows for bricks and texels that have none; there are enough.
void LatticePool::give(gpu::CommandRecorder& recorder, const std::vector<Want>& wants) {
    std::vector<std::uint32_t> used_slots, used_rows;  // that others had before
    const auto next = [](std::vector<std::uint32_t>& free, std::vector<std::uint32_t>& reused, auto& all) {
        if (free.empty()) {
            all.emplace_back();
            return static_cast<std::uint32_t>(all.size() - 1);
        }
        reused.push_back(free.back());
        free.pop_back();
        return reused.back();
    };
    for (const Want& want : wants) {
        std::uint32_t& slot_of_brick = slot_of_brick_[want.brick];
        if (slot_of_brick == 0) {
            slot_of_brick = next(free_slots_, used_slots, slots_) + 1;
            slots_[slot_of_brick - 1] = {want.brick, request_, 0};
            slot_bricks_.as<std::uint32_t>()[slot_of_brick - 1] = want.brick;
        }
        const std::uint32_t slot = slot_of_brick - 1;
        std::uint64_t fresh = whole_ ? 0 : want.texels & ~slots_[slot].texels;
        slots_[slot].texels |= want.texels;
        for (; fresh != 0; fresh &= fresh - 1) {
            const std::uint32_t row = next(free_rows_, used_rows, place_of_row_);
            place_of_row_[row] =
                static_cast<std::uint32_t>(slot * kTexels) + static_cast<std::uint32_t>(std::countr_zero(fresh));
            places_.as<std::uint32_t>()[row] = place_of_row_[row];
        }
    }
    clearRuns(recorder, shown_, used_slots, kTexels * 8);
    if (whole_) clearRuns(recorder, state_, used_slots, kTexels * kStateBytes);
    clearRuns(recorder, state_, used_rows, kStateBytes);
    recorder.submitAndWait();
    gpu::upload(device_, index_, 0, std::as_bytes(std::span(slot_of_brick_)));
}

std::optional<std::uint64_t> LatticePool::rowOf(std::uint32_t brick, std::uint32_t texel) const {
    const std::uint32_t slot = slot_of_brick_[brick];
    if (slot == 0 || ((slots_[slot - 1].texels >> texel) & 1) == 0) return std::nullopt;
    const std::uint64_t place = (slot - 1) * kTexels + texel;
    if (whole_) return place;
    return static_cast<std::uint64_t>(std::ranges::find(place_of_row_, place) - place_of_row_.begin());
}

void LatticePool::keepWhole(bool whole) {
    if (!slots_.empty()) throw Error(Code::kInternal, "an illumination lattice has texels already");
    whole_ = whole;
}

void LatticePool::makeWhole(gpu::CommandRecorder& recorder,
                            const std::function<void(const gpu::Buffer& state, const gpu::Buffer& payload)>& move) {
    if (whole_) return;
    if (capacity_.slots > 0) {
        const std::uint64_t rows = kTexels * capacity_.slots;
        gpu::Buffer state = zeros(device_, recorder, rows * kStateBytes, "lattice states");
        gpu::Buffer payload = zeros(device_, recorder, rows * payload_bytes_, "lattice payloads");
        move(state, payload);
        state_ = std::move(state);
        payload_ = std::move(payload);
        for (Slot& slot : slots_) {
            if (slot.texels != 0) slot.texels = ~std::uint64_t{0};
        }
        capacity_.rows = rows;
    }
    places_ = gpu::Buffer();
    place_of_row_.clear();
    free_rows_.clear();
    whole_ = true;
}

void LatticePool::clear() {
    slots_.clear();
    place_of_row_.clear();
    free_slots_.clear();
    free_rows_.clear();
    std::ranges::fill(slot_of_brick_, 0U);
    gpu::upload(device_, index_, 0, std::as_bytes(std::span(slot_of_brick_)));
    for (gpu::Buffer* buffer : {&state_, &payload_, &shown_, &slot_bricks_, &places_}) *buffer = gpu::Buffer();
    capacity_ = {};
}

}  // namespace radiata::render
