#include "service/worker.h"

#include <string>

#include "base/error.h"

namespace radiata::service {

Worker::Worker(std::size_t waiting_max) : waiting_max_(waiting_max), thread_([this] { work(); }) {}

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
                        "calls to the catalogue: " + std::to_string(tasks_.size()) + " are waiting; try again later");
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

}  // namespace radiata::service
