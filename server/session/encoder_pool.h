// Threads that write marks and encode, so that the render thread goes on. Bounded: the render thread asks for room first.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "encode/annotate.h"

namespace radiata::session {

class EncoderPool {
public:
    using Task = std::function<void(encode::Annotator&)>;  ///< must not throw

    /// \param on_room  called after each task, by the thread that did it
    /// \throws Error(kNotFound) if there is no such font
    EncoderPool(int threads, const std::filesystem::path& font, std::function<void()> on_room);
    /// Waits for the tasks that are there; each may be somebody's answer.
    ~EncoderPool();

    /// Whether a task may be added; at most two per thread wait or run.
    bool hasRoom() const;
    void submit(Task task);

private:
    void work(encode::Annotator annotator);

    std::function<void()> on_room_;
    std::size_t limit_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Task> tasks_;
    std::size_t running_ = 0;
    bool stopping_ = false;
    std::vector<std::jthread> threads_;
};

}  // namespace radiata::session
