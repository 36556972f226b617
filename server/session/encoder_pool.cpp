#include "session/encoder_pool.h"

#include <algorithm>
#include <memory>

namespace radiata::session {

EncoderPool::EncoderPool(int threads, const std::filesystem::path& font, std::function<void()> on_room)
    : on_room_(std::move(on_room)), limit_(static_cast<std::size_t>(std::max(threads, 1)) * 2) {
    std::vector<encode::Annotator> annotators;
    for (int i = 0; i < std::max(threads, 1); ++i) annotators.emplace_back(font);
    for (encode::Annotator& annotator : annotators) {
        threads_.emplace_back(
            [this, own = std::make_shared<encode::Annotator>(std::move(annotator))] { work(std::move(*own)); });
    }
}

EncoderPool::~EncoderPool() {
    {
        std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
}

bool EncoderPool::hasRoom() const {
    std::lock_guard lock(mutex_);
    return tasks_.size() + running_ < limit_;
}

void EncoderPool::submit(Task task) {
    {
        std::lock_guard lock(mutex_);
        tasks_.push_back(std::move(task));
    }
    changed_.notify_one();
}

void EncoderPool::work(encode::Annotator annotator) {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
        if (tasks_.empty()) return;
        Task task = std::move(tasks_.front());
        tasks_.pop_front();
        ++running_;
        lock.unlock();
        task(annotator);
        task = nullptr;
        lock.lock();
        --running_;
        lock.unlock();
        on_room_();
        lock.lock();
    }
}

}  // namespace radiata::session
