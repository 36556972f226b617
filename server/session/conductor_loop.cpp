// The render thread: choose a step, draw it without the lock, hand the picture to the encoders.
#include <algorithm>
#include <exception>
#include <utility>

#include "session/conductor.h"
#include "session/finish.h"

namespace radiata::session {
namespace {

double ms(Clock::duration duration) { return std::chrono::duration<double, std::milli>(duration).count(); }

}  // namespace

void Conductor::work() {
    Lock lock(mutex_);
    while (true) {
        if (housekeep(lock)) continue;
        if (stopping_) return;
        const std::optional<Choice> choice = encoders_.hasRoom() ? choose(Clock::now()) : std::nullopt;
        if (!choice) {
            waitForWork(lock);
        } else if (choice->view) {
            runView(lock, *choice);
        } else {
            runJob(lock, choice->id, jobs_.at(choice->id));
        }
    }
}

/// Short calls and releases. \return whether there was one; the lock was given away then
bool Conductor::housekeep(Lock& lock) {
    if (!released_.empty()) {
        const std::uint64_t id = released_.front();
        released_.pop_front();
        lock.unlock();
        backend_.release(id);
        lock.lock();
        return true;
    }
    if (!tasks_.empty()) {
        const std::function<void()> task = std::move(tasks_.front());
        tasks_.pop_front();
        lock.unlock();
        task();
        lock.lock();
        return true;
    }
    return false;
}

std::optional<Conductor::Choice> Conductor::chooseView(Clock::time_point now, bool interactive) {
    std::uint64_t& served = interactive ? served_interactive_ : served_refinement_;
    // Once around the circle of views, beginning behind the one served last.
    auto position = views_.upper_bound(served);
    for (std::size_t i = 0; i < views_.size(); ++i, ++position) {
        if (position == views_.end()) position = views_.begin();
        if (position->second->loading) continue;
        if (position->second->view.interactivePending() != interactive) continue;
        if (const std::optional<Step> step = position->second->view.next(now))
            return Choice{position->second, position->first, *step};
    }
    return std::nullopt;
}

/// Every other time the oldest job, so that it comes to an end; else the oldest of those that have taken least time.
std::optional<std::uint64_t> Conductor::chooseJob() const {
    std::optional<std::uint64_t> chosen;
    int least = 0;
    for (const auto& [id, progress] : jobs_) {
        if (progress->loading) continue;
        if (chosen && (oldest_job_ || progress->level() >= least)) continue;
        chosen = id;
        least = progress->level();
    }
    return chosen;
}

/// A job takes its turn among the views that move, as if it were the one with the highest number.
std::optional<Conductor::Choice> Conductor::choose(Clock::time_point now) {
    std::optional<Choice> view = chooseView(now, true);
    const std::optional<std::uint64_t> job = chooseJob();
    if (job && (!view || view->id <= served_interactive_)) {
        // Turns wrap around here: the job first, then the views from the lowest number.
        served_interactive_ = 0;
        oldest_job_ = !oldest_job_;
        return Choice{nullptr, *job, {}};
    }
    if (view) {
        served_interactive_ = view->id;
        return view;
    }
    view = chooseView(now, false);
    if (view) served_refinement_ = view->id;
    return view;
}

void Conductor::waitForWork(Lock& lock) {
    std::optional<Clock::time_point> wake;
    if (encoders_.hasRoom()) {
        for (const auto& [id, entry] : views_) {
            if (entry->loading) continue;
            const auto at = entry->view.wakeAt();
            if (at && (!wake || *at < *wake)) wake = at;
        }
    }
    // Everything else that makes work notifies.
    if (wake) {
        changed_.wait_until(lock, *wake);
    } else {
        changed_.wait(lock);
    }
}

void Conductor::runView(Lock& lock, Choice choice) {
    View& view = choice.view->view;
    Step& step = choice.step;
    view.started(step);
    const model::FrameRequest request = view.request();
    running_ = std::make_shared<Running>();
    running_->id = choice.id;
    running_->refines = !step.interactive;
    running_->expected_ms = view.sampleMs() * step.count;
    const std::shared_ptr<Running> running = running_;
    lock.unlock();

    const Clock::time_point begin = Clock::now();
    std::optional<model::Frame> frame;
    std::optional<Error> failure;
    try {
        frame = backend_.render(choice.id, request, step.first_sample, step.count, {}, &running->cancel);
        // Light that takes longer than a step leaves samples for the next one.
        if (frame->info.samples < step.first_sample + step.count) step.state = model::FrameState::kRefining;
        frame->info.state = step.state;
    } catch (...) {
        failure = currentError();
    }
    const Clock::time_point end = Clock::now();

    lock.lock();
    running_.reset();
    if (failure && failure->code() == Code::kCancelled && running->cancel) {
        view.cancelled(step);
    } else if (failure) {
        endView(lock, choice.id, *failure);
    } else if (view.rendered(step, ms(end - begin), frame ? std::optional<int>(frame->info.samples) : std::nullopt)) {
        if (!views_.contains(choice.id)) return;
        encodeView(choice, std::move(*frame), ms(begin - step.arrival));
    }
}

void Conductor::encodeView(const Choice& choice, model::Frame frame, double queue_ms) {
    auto shared = std::make_shared<model::Frame>(std::move(frame));
    encoders_.submit([this, choice, shared, queue_ms](encode::Annotator& annotator) {
        const Step& step = choice.step;
        std::optional<StreamFrame> finished;
        std::optional<Error> failure;
        try {
            const bool converged = step.state == model::FrameState::kConverged;
            finished = finish(std::move(*shared), converged ? ImageFormat::kPng : ImageFormat::kJpeg, annotator);
            finished->camera_sequence = step.camera_sequence;
            finished->timing.queue_ms = queue_ms;
            finished->timing.client_time_ms = step.client_time_ms;
        } catch (...) {
            failure = currentError();
        }
        Lock lock(mutex_);
        if (!views_.contains(choice.id)) return;
        if (failure) return endView(lock, choice.id, *failure);
        if (!choice.view->view.offer(std::move(*finished), step)) {
            changed_.notify_all();
            return;
        }
        changed_.notify_all();
        lock.unlock();
        choice.view->callbacks.ready();
    });
}

void Conductor::runJob(Lock& lock, std::uint64_t id, const std::shared_ptr<JobProgress>& progress) {
    const std::shared_ptr<JobProgress> job = progress;  // the map may lose it meanwhile
    running_ = std::make_shared<Running>();
    running_->id = id;
    running_->cancel = job->cancel.load();
    const std::shared_ptr<Running> running = running_;
    lock.unlock();

    const Clock::time_point begin = Clock::now();
    if (!job->begin) job->begin = begin;
    const int count = job->nextCount(settings_.pace.step_budget);
    std::optional<model::Frame> frame;
    std::optional<Error> failure;
    try {
        const model::Outputs outputs = job->has_outputs ? model::Outputs{} : job->job.outputs;
        frame = backend_.render(id, job->job.request, job->samples_done, count, outputs, &running->cancel);
        if (!std::exchange(job->has_outputs, true)) {
            std::vector<std::uint8_t> rgba = std::move(frame->pixels.rgba);
            job->outputs = std::move(frame->pixels);
            frame->pixels = {};
            frame->pixels.rgba = std::move(rgba);
        }
    } catch (...) {
        failure = currentError();
    }
    const double took_ms = ms(Clock::now() - begin);
    job->sample_ms = std::max(took_ms / std::max(count, 1), 1e-3);
    job->render_ms += took_ms;
    if (frame) job->samples_done = frame->info.samples;

    lock.lock();
    running_.reset();
    const bool finished = !failure && job->samples_done >= job->job.request.quality.samples;
    if (stopping_ && !finished) failure = Error(Code::kUnavailable, "the server is stopping; connect again later");
    if (!failure && !finished) return;
    jobs_.erase(id);
    released_.push_back(id);
    if (failure) {
        lock.unlock();
        job->job.failed(*failure);
        lock.lock();
        return;
    }
    encodeJob(job, std::move(*frame));
}

void Conductor::encodeJob(std::shared_ptr<JobProgress> job, model::Frame frame) {
    frame.info.state = model::FrameState::kConverged;
    frame.info.render_ms = job->render_ms;
    const int width = job->outputs.width;
    const int height = job->outputs.height;
    std::vector<std::uint8_t> rgba = std::move(frame.pixels.rgba);
    frame.pixels = std::move(job->outputs);
    frame.pixels.width = width;
    frame.pixels.height = height;
    frame.pixels.rgba = std::move(rgba);
    auto shared = std::make_shared<model::Frame>(std::move(frame));
    encoders_.submit([job = std::move(job), shared](encode::Annotator& annotator) {
        try {
            StreamFrame finished = finish(std::move(*shared), job->job.format, annotator);
            finished.timing.queue_ms = ms(*job->begin - job->arrival);
            finished.timing.total_ms = ms(Clock::now() - job->arrival);
            job->job.done(std::move(finished));
        } catch (...) {
            job->job.failed(currentError());
        }
    });
}

}  // namespace radiata::session
