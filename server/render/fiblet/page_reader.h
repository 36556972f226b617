// Reads pages of fiblets on a thread of its own, so that no frame waits for a disk.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "model/fiblet_set.h"

namespace radiata::render {

struct ReadPage {
    std::uint32_t page = 0;
    std::vector<model::FibletHead> heads;
    std::vector<std::uint32_t> codes;
};

class PageReader {
public:
    /// From the set's file, or from memory where it has none.
    explicit PageReader(std::shared_ptr<const model::FibletSet> set);
    ~PageReader();

    /// What is to be read next, in this order. Pages that were wanted before and were not begun are forgotten.
    void want(std::span<const std::uint32_t> pages);
    /// What was read since the last call, after waiting for something up to `wait` if there is nothing and something is to
    /// come. \throws what the file threw, once
    std::vector<ReadPage> take(std::chrono::milliseconds wait = {});

private:
    void work();
    void readRun(std::span<const std::uint32_t> run, std::vector<ReadPage>& into) const;

    std::shared_ptr<const model::FibletSet> set_;
    std::mutex mutex_;
    std::condition_variable wanted_changed_, read_changed_;
    std::vector<std::uint32_t> wanted_;   ///< the next is the last
    std::vector<std::uint32_t> reading_;  ///< begun, or read and not taken yet; ascending
    std::vector<ReadPage> read_;
    std::exception_ptr failure_;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace radiata::render
