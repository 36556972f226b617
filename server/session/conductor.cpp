// The side of Conductor that other threads call. conductor_loop.cpp has the render thread's.
#include "session/conductor.h"

#include <string>
#include <vector>

#include "session/finish.h"

namespace radiata::session {
namespace {

constexpr double kPreempt_ms = 250;  // refinement steps longer than this make way for another view's camera

Error stoppingError() { return {Code::kUnavailable, "the server is stopping; connect again later"}; }

}  // namespace

Conductor::Conductor(Backend backend, Settings settings)
    : backend_(std::move(backend)),
      settings_(std::move(settings)),
      encoders_(settings_.encoder_threads, settings_.font,
                [this] {
                    // With the lock, so that the render thread cannot miss it between its look and its wait.
                    std::lock_guard lock(mutex_);
                    changed_.notify_all();
                }),
      loaders_(static_cast<std::size_t>(settings_.limits.views_max + settings_.jobs_max), settings_.loader_threads),
      thread_([this] { work(); }) {}

Conductor::~Conductor() {
    stop();
    thread_.join();
}

void Conductor::refuseWhenStopping() const {
    if (stopping_) throw stoppingError();
}

std::uint64_t Conductor::open(const model::FrameRequest& request, int window, ViewCallbacks callbacks) {
    model::validate(request, settings_.limits);
    if (window < 1 || window > settings_.limits.window_max) {
        throw Error(Code::kInvalidArgument,
                    "window is " + std::to_string(window) + "; it must be 1 to " + std::to_string(settings_.limits.window_max));
    }
    const bool there = ready(request);
    std::lock_guard lock(mutex_);
    refuseWhenStopping();
    if (views_.size() >= static_cast<std::size_t>(settings_.limits.views_max)) {
        throw Error(Code::kResourceExhausted, "open views: " + std::to_string(views_.size()) +
                                                  " are open, which is the limit; close one or try again later");
    }
    const std::uint64_t id = ++last_id_;
    if (!there) load(id, request);
    views_.emplace(
        id, std::make_shared<Entry>(Entry{View(request, window, settings_.pace, Clock::now()), std::move(callbacks), !there}));
    changed_.notify_all();
    return id;
}

void Conductor::update(std::uint64_t id, const Change& change) {
    std::lock_guard lock(mutex_);
    refuseWhenStopping();
    const auto found = views_.find(id);
    if (found == views_.end()) throw Error(Code::kNotFound, "the view is closed");
    View& view = found->second->view;
    if (change.camera || change.scene || change.quality || change.size) {
        const model::FrameRequest merged = view.merged(change);
        model::validate(merged, settings_.limits);
        // While one load is under way the next waits, so that who drags an isovalue waits for the last value, not for all.
        if ((change.scene || change.quality) && !found->second->loading && !ready(merged)) {
            load(id, merged);
            found->second->loading = true;
        }
    }
    const bool different = view.apply(change, Clock::now());
    if (different && running_ && running_->refines && (running_->id == id || running_->expected_ms > kPreempt_ms)) {
        running_->cancel = true;
    }
    changed_.notify_all();
}

bool Conductor::ready(const model::FrameRequest& request) const {
    return backend_.resident(request) && (!backend_.made || backend_.made(request));
}

/// With the lock held, before the view or job counts it: the answer waits for the lock.
void Conductor::load(std::uint64_t id, const model::FrameRequest& request) {
    loaders_.post([this, id, request] {
        {
            std::lock_guard lock(mutex_);
            if (stopping_) return;
        }
        std::optional<Error> failure;
        try {
            backend_.load(request);
            if (backend_.make) backend_.make(request);
        } catch (...) {
            failure = currentError();
        }
        loaded(id, failure);
    });
}

void Conductor::loaded(std::uint64_t id, const std::optional<Error>& failure) {
    Lock lock(mutex_);
    changed_.notify_all();
    if (const auto found = views_.find(id); found != views_.end()) {
        std::optional<Error> problem = failure;
        try {
            const model::FrameRequest latest = found->second->view.merged({});
            found->second->loading = !problem && !ready(latest);
            if (found->second->loading) load(id, latest);
        } catch (...) {
            problem = currentError();
        }
        if (problem) endView(lock, id, *problem);
        return;
    }
    const auto found = jobs_.find(id);
    if (found == jobs_.end()) return;  // closed or cancelled meanwhile
    const std::shared_ptr<JobProgress> job = found->second;
    job->loading = false;
    if (!failure) return;
    jobs_.erase(found);
    lock.unlock();
    job->job.failed(*failure);
}

std::optional<StreamFrame> Conductor::take(std::uint64_t id) {
    std::lock_guard lock(mutex_);
    const auto found = views_.find(id);
    if (found == views_.end()) return std::nullopt;
    return found->second->view.take(Clock::now());
}

model::FrameRequest Conductor::requestOf(std::uint64_t id, std::uint64_t sequence) {
    std::lock_guard lock(mutex_);
    const auto found = views_.find(id);
    if (found == views_.end()) throw Error(Code::kNotFound, "the view is closed");
    return found->second->view.requestOf(sequence);
}

void Conductor::close(std::uint64_t id) {
    std::lock_guard lock(mutex_);
    if (views_.erase(id) == 0) return;
    if (running_ && running_->id == id) running_->cancel = true;
    released_.push_back(id);
    changed_.notify_all();
}

void Conductor::endView(Lock& lock, std::uint64_t id, const Error& error) {
    const auto found = views_.find(id);
    if (found == views_.end()) return;
    const std::shared_ptr<Entry> entry = found->second;
    views_.erase(found);
    released_.push_back(id);
    changed_.notify_all();
    lock.unlock();
    entry->callbacks.ended(error);
    lock.lock();
}

std::uint64_t Conductor::render(RenderJob job) {
    model::validate(job.request, settings_.limits);
    const bool there = ready(job.request);
    std::lock_guard lock(mutex_);
    refuseWhenStopping();
    if (jobs_.size() >= static_cast<std::size_t>(settings_.jobs_max)) {
        throw Error(Code::kResourceExhausted, "pictures to render: " + std::to_string(jobs_.size()) +
                                                  " are waiting, which is the limit; try again later");
    }
    const std::uint64_t id = ++last_id_;
    if (!there) load(id, job.request);
    auto progress = std::make_shared<JobProgress>();
    progress->loading = !there;
    progress->job = std::move(job);
    progress->arrival = Clock::now();
    jobs_.emplace(id, std::move(progress));
    changed_.notify_all();
    return id;
}

void Conductor::cancel(std::uint64_t id) {
    Lock lock(mutex_);
    const auto found = jobs_.find(id);
    if (found == jobs_.end()) return;
    found->second->cancel = true;
    // The render thread ends the one that it draws itself.
    if (running_ && running_->id == id) {
        running_->cancel = true;
        return;
    }
    const std::shared_ptr<JobProgress> job = found->second;
    jobs_.erase(found);
    released_.push_back(id);
    changed_.notify_all();
    lock.unlock();
    job->job.failed(Error(Code::kCancelled, "the picture is not wanted any more"));
}

void Conductor::post(std::function<void()> task) {
    std::lock_guard lock(mutex_);
    refuseWhenStopping();
    if (tasks_.size() >= static_cast<std::size_t>(settings_.tasks_max)) {
        throw Error(Code::kResourceExhausted,
                    "calls to the renderer: " + std::to_string(tasks_.size()) + " are waiting; try again later");
    }
    tasks_.push_back(std::move(task));
    changed_.notify_all();
}

void Conductor::stop() {
    Lock lock(mutex_);
    if (stopping_) return;
    stopping_ = true;
    if (running_) running_->cancel = true;
    const auto views = std::move(views_);
    const auto jobs = std::move(jobs_);
    views_.clear();
    jobs_.clear();
    for (const auto& [id, entry] : views) released_.push_back(id);
    const std::uint64_t drawn = running_ ? running_->id : 0;
    changed_.notify_all();
    lock.unlock();
    for (const auto& [id, entry] : views) entry->callbacks.ended(stoppingError());
    for (const auto& [id, job] : jobs) {
        if (id != drawn) job->job.failed(stoppingError());
    }
}

}  // namespace radiata::session
