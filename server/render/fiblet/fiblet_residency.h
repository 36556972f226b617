// Which fiblets of a tractogram beyond the memory budget are on the device: some of its pages, each in a slot, which give way
// to others when they were not wanted for longest; and of all other pages the fiblets of a subset of fibres, taken at random by
// a fixed seed, which are always there. So of any page something can be drawn at any time.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "build/fiblet_subset.h"
#include "gpu/buffer.h"
#include "gpu/recorder.h"
#include "render/fiblet/page_reader.h"

namespace radiata::render {

/// Not thread-safe: for the thread that draws.
class FibletResidency {
public:
    using Clock = std::chrono::steady_clock;

    /// What the whole set takes on the device, its pages' boxes included.
    static std::uint64_t wholeBytes(const model::FibletSet& set);

    /// \param budget_bytes  of all that the tractogram has on the device whatever draws it: a quarter of what the table of
    /// pages leaves is the subset's \throws Error(kResourceExhausted) saying what it would need, if no page would have room
    FibletResidency(gpu::Device& device, std::shared_ptr<const model::FibletSet> set, std::uint64_t budget_bytes);

    std::uint64_t headAddress() const { return heads_.address(); }
    std::uint64_t boxAddress() const { return boxes_.address(); }
    std::uint64_t codeAddress() const { return codes_.address(); }
    /// shader::FibletPlaces, then shader::FibletPlace of each page.
    std::uint64_t placeAddress() const { return places_.address(); }

    std::uint32_t slots() const { return static_cast<std::uint32_t>(pages_of_slots_.size()); }
    std::uint32_t residentPages() const { return resident_; }
    std::uint64_t subsetFibres() const { return subset_.fibres; }
    /// Fiblets that are on the device at most.
    std::uint64_t fibletsMax() const;
    std::uint64_t deviceBytes() const;
    std::uint64_t bytesRead() const { return bytes_read_; }

    /// A picture begins: what earlier ones took may give way. \return  a number that rises
    std::uint64_t begin();
    std::uint64_t serial() const { return serial_; }
    /// The picture shows this page. \return  false: it has no room beside those that the picture has taken already, and only
    /// the subset stands for it
    bool take(std::uint32_t page);
    bool resident(std::uint32_t page) const { return slot_of_page_[page] != kNone; }

    /// Has pages read, the first first, and brings to the device what was read by now, without waiting.
    void want(gpu::CommandRecorder& recorder, std::span<const std::uint32_t> pages);
    /// Brings pages that were taken to the device. \param until  after which the rest is left to want(); none: all are waited
    /// for \return  whether all are there. \throws Error(kCancelled), Error of the file
    bool fetch(gpu::CommandRecorder& recorder, std::span<const std::uint32_t> pages, std::optional<Clock::time_point> until,
               const std::atomic<bool>* cancel);

private:
    static constexpr std::uint32_t kNone = 0xffffffffU;

    shader::FibletPlace* places() const;
    /// Into slots, as far as pages that the picture has not taken give way.
    void place(gpu::CommandRecorder& recorder, std::span<const ReadPage> pages);
    std::uint32_t freeSlot();
    void drop(std::uint32_t page);
    void copyPages(gpu::CommandRecorder& recorder, std::span<const ReadPage> pages, std::span<const std::uint32_t> slots);

    gpu::Device& device_;
    std::shared_ptr<const model::FibletSet> set_;
    FibletSubset subset_;  ///< without heads, boxes and codes, which are on the device
    std::uint32_t subset_heads_ = 0;
    std::uint32_t slot_words_ = 0;               ///< codes of the largest page
    std::vector<std::uint32_t> slot_of_page_;    ///< or kNone
    std::vector<std::uint64_t> taken_;           ///< serial of the latest picture that shows the page
    std::vector<std::uint32_t> pages_of_slots_;  ///< or kNone
    std::list<std::uint32_t> order_;             ///< slots, the one that was wanted last at the end
    std::vector<std::list<std::uint32_t>::iterator> place_in_order_;
    std::uint64_t serial_ = 1;
    std::uint32_t taken_count_ = 0, resident_ = 0;
    std::uint64_t bytes_read_ = 0;
    gpu::Buffer heads_, boxes_, codes_, places_, staging_;
    PageReader reader_;
};

}  // namespace radiata::render
