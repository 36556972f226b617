#include "render/fiblet/page_reader.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace radiata::render {
namespace {

/// Pages that are read between two looks at what is wanted.
constexpr std::size_t kPagesAtOnce = 64;

std::uint64_t wordsEnd(const model::FibletSet& set, std::uint32_t page) {
    return page + 1 < set.pages.size() ? set.pages[page + 1].first_word : set.codes.size() - 1;
}

}  // namespace

PageReader::PageReader(std::shared_ptr<const model::FibletSet> set) : set_(std::move(set)), thread_([this] { work(); }) {}

PageReader::~PageReader() {
    {
        std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    wanted_changed_.notify_all();
    thread_.join();
}

void PageReader::want(std::span<const std::uint32_t> pages) {
    {
        std::lock_guard lock(mutex_);
        wanted_.clear();
        for (auto page = pages.rbegin(); page != pages.rend(); ++page) {
            if (!std::ranges::binary_search(reading_, *page)) wanted_.push_back(*page);
        }
    }
    wanted_changed_.notify_all();
}

std::vector<ReadPage> PageReader::take(std::chrono::milliseconds wait) {
    std::unique_lock lock(mutex_);
    if (wait.count() > 0) {
        read_changed_.wait_for(lock, wait,
                               [this] { return !read_.empty() || failure_ || (wanted_.empty() && reading_.empty()); });
    }
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    for (const ReadPage& page : read_) reading_.erase(std::ranges::lower_bound(reading_, page.page));
    return std::exchange(read_, {});
}

void PageReader::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        wanted_changed_.wait(lock, [this] { return stopping_ || !wanted_.empty(); });
        if (stopping_) return;
        const std::size_t count = std::min(wanted_.size(), kPagesAtOnce);
        std::vector<std::uint32_t> batch(wanted_.end() - static_cast<std::ptrdiff_t>(count), wanted_.end());
        wanted_.resize(wanted_.size() - count);
        std::ranges::sort(batch);
        std::vector<std::uint32_t> all;
        std::ranges::merge(reading_, batch, std::back_inserter(all));
        reading_ = std::move(all);
        lock.unlock();
        std::vector<ReadPage> pages;
        std::exception_ptr failure;
        try {
            // Neighbours in the brain are neighbours in the file: one read takes all that follow each other.
            for (std::size_t first = 0, end; first < batch.size(); first = end) {
                for (end = first + 1; end < batch.size() && batch[end] == batch[end - 1] + 1;) ++end;
                readRun(std::span(batch).subspan(first, end - first), pages);
            }
        } catch (...) {
            failure = std::current_exception();
            pages.clear();
        }
        lock.lock();
        if (failure) {
            failure_ = failure;
            std::erase_if(reading_, [&](std::uint32_t page) { return std::ranges::binary_search(batch, page); });
        }
        for (ReadPage& page : pages) read_.push_back(std::move(page));
        read_changed_.notify_all();
    }
}

void PageReader::readRun(std::span<const std::uint32_t> run, std::vector<ReadPage>& into) const {
    const std::vector<shader::FibletPage>& pages = set_->pages;
    const std::size_t first_head = std::size_t{run.front()} * shader::FIBLET_PAGE;
    const std::size_t head_count = std::size_t{run.back() - run.front()} * shader::FIBLET_PAGE + pages[run.back()].count;
    const std::uint64_t first_word = pages[run.front()].first_word, word_count = wordsEnd(*set_, run.back()) - first_word;
    std::vector<model::FibletHead> heads(head_count);
    std::vector<std::uint32_t> codes(word_count);
    if (set_->file) {
        set_->file->read(run.front(), static_cast<std::uint32_t>(run.size()), heads, codes);
    } else {
        std::ranges::copy(std::span(set_->heads).subspan(first_head, head_count), heads.begin());
        std::ranges::copy(std::span(set_->codes).subspan(first_word, word_count), codes.begin());
    }
    for (const std::uint32_t page : run) {
        const auto head = heads.begin() + static_cast<std::ptrdiff_t>(std::size_t{page - run.front()} * shader::FIBLET_PAGE);
        const auto word = codes.begin() + static_cast<std::ptrdiff_t>(pages[page].first_word - first_word);
        into.push_back({page,
                        {head, head + pages[page].count},
                        {word, word + static_cast<std::ptrdiff_t>(wordsEnd(*set_, page) - pages[page].first_word)}});
    }
}

}  // namespace radiata::render
