// Threads for calls that may read files, so that neither gRPC's own threads nor the one that renders wait for them.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace radiata::session {

class Worker {
public:
    explicit Worker(std::size_t waiting_max = 64, int threads = 1);
    /// Waits for the tasks that are there; each is somebody's answer.
    ~Worker();

    /// \param task  must not throw  \throws Error(kResourceExhausted) if too many wait
    void post(std::function<void()> task);

private:
    void work();

    std::size_t waiting_max_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> tasks_;
    bool stopping_ = false;
    std::vector<std::jthread> threads_;
};

}  // namespace radiata::session
