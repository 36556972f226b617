#include "session/worker.h"

#include <string>

#include "base/error.h"

namespace radiata::session {

Worker::Worker(std::size_t waiting_max, int threads) : waiting_max_(waiting_max) {
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

Worker::~Worker() {
    {
        std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_all();
}

void Worker::post(std::function<void()> task) {
    {
        std::lock_guard lock(mutex_);
        if (tasks_.size() >= waiting_max_) {
            throw Error(Code::kResourceExhausted,
                        "calls that read files: " + std::to_string(tasks_.size()) + " are waiting; try again later");
        }
        tasks_.push_back(std::move(task));
    }
    changed_.notify_one();
}

void Worker::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
        if (tasks_.empty()) return;
        const std::function<void()> task = std::move(tasks_.front());
        tasks_.pop_front();
        lock.unlock();
        task();
        lock.lock();
    }
}

}  // namespace radiata::session
