#include "render/fiblet/fiblet_residency.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>

#include "base/error.h"
#include "gpu/device.h"

namespace radiata::render {
namespace {

constexpr std::uint64_t kHeadBytes = sizeof(model::FibletHead), kBoxBytes = sizeof(shader::FibletBox);
constexpr std::uint64_t kPageRecordBytes = shader::FIBLET_PAGE * (kHeadBytes + kBoxBytes);
/// A frame with fewer would show hardly more than the subset.
constexpr std::uint64_t kSlotsMin = 4;
/// Pages that one submission brings to the device.
constexpr std::size_t kPagesAtOnce = 64;
/// Between two looks at whether the picture is still wanted.
constexpr std::chrono::milliseconds kWait{10};

std::uint32_t largestPageWords(const model::FibletSet& set) {
    std::uint64_t most = 0;
    for (std::size_t p = 0; p < set.pages.size(); ++p) {
        const std::uint64_t end = p + 1 < set.pages.size() ? set.pages[p + 1].first_word : set.codes.size() - 1;
        most = std::max(most, end - set.pages[p].first_word);
    }
    return static_cast<std::uint32_t>(most);
}

/// Table of places and boxes of pages.
std::uint64_t tableBytes(const model::FibletSet& set) {
    return sizeof(shader::FibletPlaces) + set.pages.size() * (sizeof(shader::FibletPlace) + sizeof(shader::FibletPage));
}

std::string mebibytes(std::uint64_t bytes) { return std::to_string((bytes + (1U << 20) - 1) >> 20) + " MiB"; }

template <typename T>
void uploadAt(gpu::Device& device, const gpu::Buffer& buffer, std::uint64_t first, const std::vector<T>& values) {
    gpu::upload(device, buffer, first * sizeof(T), std::as_bytes(std::span(values)));
}

}  // namespace

std::uint64_t FibletResidency::wholeBytes(const model::FibletSet& set) {
    return set.heads.size() * (kHeadBytes + kBoxBytes) + 4 * set.codes.size() + set.pages.size() * sizeof(shader::FibletPage);
}

FibletResidency::FibletResidency(gpu::Device& device, std::shared_ptr<const model::FibletSet> set, std::uint64_t budget_bytes)
    : device_(device), set_(std::move(set)), slot_words_(largestPageWords(*set_)), reader_(set_) {
    const std::uint64_t slot_bytes = kPageRecordBytes + std::uint64_t{4} * slot_words_, table = tableBytes(*set_);
    const std::uint64_t left = budget_bytes - std::min(budget_bytes, table);
    subset_ = fibletSubset(*set_, left / 4);
    subset_heads_ = static_cast<std::uint32_t>(subset_.heads.size());
    const std::uint64_t subset_bytes = subset_.heads.size() * (kHeadBytes + kBoxBytes) + 4 * (subset_.codes.size() + 1);
    const std::uint64_t slots = std::min<std::uint64_t>((left - std::min(left, subset_bytes)) / slot_bytes, set_->pages.size());
    if (slots < kSlotsMin) {
        throw Error(Code::kResourceExhausted, set_->source + " takes " + mebibytes(wholeBytes(*set_)) +
                                                  " on the device; the budget of " + mebibytes(budget_bytes) +
                                                  " does not hold its table of pages and a few of them, which takes " +
                                                  mebibytes(table + kSlotsMin * slot_bytes * 4 / 3 + 4));
    }
    const std::uint64_t fiblets = slots * shader::FIBLET_PAGE + subset_heads_;
    heads_ = gpu::Buffer(device, fiblets * kHeadBytes, gpu::Memory::kDevice, "fiblet heads");
    boxes_ = gpu::Buffer(device, fiblets * kBoxBytes, gpu::Memory::kDevice, "fiblet boxes");
    codes_ = gpu::Buffer(device, 4 * (slots * slot_words_ + subset_.codes.size() + 1), gpu::Memory::kDevice, "fiblet codes");
    places_ = gpu::Buffer(device, sizeof(shader::FibletPlaces) + subset_.places.size() * sizeof(shader::FibletPlace),
                          gpu::Memory::kUpload, "fiblet places");
    // Slots come first, the subset behind them.
    for (shader::FibletPlace& place : subset_.places) {
        place.first_head += static_cast<std::uint32_t>(slots * shader::FIBLET_PAGE);
        place.first_word += static_cast<std::uint32_t>(slots * slot_words_);
    }
    uploadAt(device, heads_, slots * shader::FIBLET_PAGE, subset_.heads);
    uploadAt(device, boxes_, slots * shader::FIBLET_PAGE, subset_.boxes);
    uploadAt(device, codes_, slots * slot_words_, subset_.codes);
    subset_.heads = {};
    subset_.boxes = {};
    subset_.codes = {};
    places_.as<shader::FibletPlaces>()[0] = {heads_.address(), 0};
    std::ranges::copy(subset_.places, places());
    slot_of_page_.assign(set_->pages.size(), kNone);
    taken_.assign(set_->pages.size(), 0);
    pages_of_slots_.assign(slots, kNone);
    order_.resize(slots);
    std::iota(order_.begin(), order_.end(), 0U);
    for (auto slot = order_.begin(); slot != order_.end(); ++slot) place_in_order_.push_back(slot);
}

shader::FibletPlace* FibletResidency::places() const {
    return reinterpret_cast<shader::FibletPlace*>(places_.mapped().data() + sizeof(shader::FibletPlaces));
}

std::uint64_t FibletResidency::fibletsMax() const { return std::uint64_t{slots()} * shader::FIBLET_PAGE + subset_heads_; }

std::uint64_t FibletResidency::deviceBytes() const {
    return heads_.sizeBytes() + boxes_.sizeBytes() + codes_.sizeBytes() + places_.sizeBytes();
}

std::uint64_t FibletResidency::begin() {
    taken_count_ = 0;
    return ++serial_;
}

bool FibletResidency::take(std::uint32_t page) {
    if (taken_[page] == serial_) return true;
    if (taken_count_ == slots()) {
        // Its slot is that of another page, which may not have come yet.
        if (resident(page)) drop(page);
        return false;
    }
    taken_[page] = serial_;
    ++taken_count_;
    if (const std::uint32_t slot = slot_of_page_[page]; slot != kNone) {
        order_.splice(order_.end(), order_, place_in_order_[slot]);
    }
    return true;
}

void FibletResidency::drop(std::uint32_t page) {
    const std::uint32_t slot = std::exchange(slot_of_page_[page], kNone);
    pages_of_slots_[slot] = kNone;
    places()[page] = subset_.places[page];
    order_.splice(order_.begin(), order_, place_in_order_[slot]);
    --resident_;
}

void FibletResidency::want(gpu::CommandRecorder& recorder, std::span<const std::uint32_t> pages) {
    place(recorder, reader_.take());
    std::vector<std::uint32_t> missing;
    std::ranges::copy_if(pages, std::back_inserter(missing), [&](std::uint32_t page) { return !resident(page); });
    reader_.want(missing);
}

bool FibletResidency::fetch(gpu::CommandRecorder& recorder, std::span<const std::uint32_t> pages,
                            std::optional<Clock::time_point> until, const std::atomic<bool>* cancel) {
    const auto missing = [&] { return std::ranges::any_of(pages, [&](std::uint32_t page) { return !resident(page); }); };
    want(recorder, pages);
    while (missing()) {
        if (cancel && *cancel) throw Error(Code::kCancelled, "nobody waits for the picture any more");
        if (until && Clock::now() >= *until) return false;
        place(recorder, reader_.take(kWait));
    }
    return true;
}

std::uint32_t FibletResidency::freeSlot() {
    const auto oldest = std::ranges::find_if(order_, [this](std::uint32_t slot) {
        return pages_of_slots_[slot] == kNone || taken_[pages_of_slots_[slot]] != serial_;
    });
    if (oldest == order_.end()) return kNone;
    const std::uint32_t slot = *oldest;
    if (pages_of_slots_[slot] != kNone) drop(pages_of_slots_[slot]);
    order_.splice(order_.end(), order_, place_in_order_[slot]);
    ++resident_;
    return slot;
}

void FibletResidency::place(gpu::CommandRecorder& recorder, std::span<const ReadPage> pages) {
    for (std::size_t first = 0; first < pages.size(); first += kPagesAtOnce) {
        std::vector<ReadPage> placed;
        std::vector<std::uint32_t> slots;
        for (const ReadPage& page : pages.subspan(first, std::min(kPagesAtOnce, pages.size() - first))) {
            const std::uint32_t slot = resident(page.page) ? kNone : freeSlot();
            if (slot == kNone) continue;
            pages_of_slots_[slot] = page.page;
            slot_of_page_[page.page] = slot;
            slots.push_back(slot);
            placed.push_back(page);
        }
        copyPages(recorder, placed, slots);
    }
}

void FibletResidency::copyPages(gpu::CommandRecorder& recorder, std::span<const ReadPage> pages,
                                std::span<const std::uint32_t> slots) {
    if (pages.empty()) return;
    const std::uint64_t slot_bytes = kPageRecordBytes + std::uint64_t{4} * slot_words_;
    if (!staging_) staging_ = gpu::Buffer(device_, kPagesAtOnce * slot_bytes, gpu::Memory::kUpload, "fiblet page staging");
    std::uint64_t at = 0;
    const auto copy = [&](std::span<const std::byte> bytes, const gpu::Buffer& to, std::uint64_t offset) {
        if (bytes.empty()) return;
        std::memcpy(staging_.mapped().data() + at, bytes.data(), bytes.size());
        recorder.copy(staging_, at, to, offset, bytes.size());
        at += bytes.size();
    };
    for (std::size_t i = 0; i < pages.size(); ++i) {
        const ReadPage& page = pages[i];
        const std::uint64_t first_head = std::uint64_t{slots[i]} * shader::FIBLET_PAGE;
        const auto count = static_cast<std::uint32_t>(page.heads.size());
        copy(std::as_bytes(std::span(page.heads)), heads_, first_head * kHeadBytes);
        copy(std::as_bytes(std::span(set_->boxes).subspan(std::size_t{page.page} * shader::FIBLET_PAGE, count)), boxes_,
             first_head * kBoxBytes);
        copy(std::as_bytes(std::span(page.codes)), codes_, std::uint64_t{4} * slots[i] * slot_words_);
        const std::uint64_t held = count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
        places()[page.page] = {static_cast<std::uint32_t>(first_head), slots[i] * slot_words_, static_cast<std::uint32_t>(held),
                               static_cast<std::uint32_t>(held >> 32)};
        bytes_read_ += page.heads.size() * kHeadBytes + 4 * page.codes.size();
    }
    recorder.submitAndWait();
}

}  // namespace radiata::render
