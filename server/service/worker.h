// One thread for calls that may read files, so that gRPC's own threads never wait.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace radiata::service {

class Worker {
public:
    explicit Worker(std::size_t waiting_max = 64);
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
    std::jthread thread_;
};

}  // namespace radiata::service
