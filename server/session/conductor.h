// Decides what is rendered next and for whom. One thread renders; views take turns, and work that answers a moving camera
// goes before work that refines a resting one. Pictures that somebody asked for alone take turns, too, so that a short one
// waits for a step of a long one, not for its end. Datasets are read by other threads, so that a large one holds up nobody but
// those who asked for it. Nothing waits without an end: windows, queues and steps are bounded.
#pragma once

#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "base/error.h"
#include "model/limits.h"
#include "session/backend.h"
#include "session/encoder_pool.h"
#include "session/render_job.h"
#include "session/view.h"
#include "session/worker.h"

namespace radiata::session {

struct Settings {
    model::Limits limits;
    Pace pace;
    int encoder_threads = 2;
    int loader_threads = 2;
    int jobs_max = 8;    ///< pictures waiting for RenderService
    int tasks_max = 64;  ///< short calls waiting for the render thread
    std::filesystem::path font = encode::kDefaultFont;
};

/// Both may be called by any thread, with no lock held; neither may throw. After close() they may still run once.
struct ViewCallbacks {
    std::function<void()> ready;              ///< take() may have a frame
    std::function<void(const Error&)> ended;  ///< the view is gone; the last call
};

/// Thread-safe.
class Conductor {
public:
    /// \throws Error(kNotFound) if the font is not there
    Conductor(Backend backend, Settings settings);
    ~Conductor();

    /// \param window  unacknowledged frames at most  \return the view's number
    /// \throws Error of model::validate, Error(kInvalidArgument) for the window, Error(kResourceExhausted) if too many are open
    std::uint64_t open(const model::FrameRequest& request, int window, ViewCallbacks callbacks);
    /// A refused change leaves the view as it was.
    /// \throws Error(kNotFound) if the view is gone, Error of model::validate
    void update(std::uint64_t view, const Change& change);
    /// The view's newest frame that was not taken yet.
    std::optional<StreamFrame> take(std::uint64_t view);
    /// What a frame of the view was drawn from. \throws Error(kNotFound) if the view is gone, or as View::requestOf()
    model::FrameRequest requestOf(std::uint64_t view, std::uint64_t sequence);
    /// Cancels what is drawn for it. Nothing if it is gone already.
    void close(std::uint64_t view);

    /// Queues a picture. \return its number for cancel()
    /// \throws Error of model::validate, Error(kResourceExhausted) if too many wait
    std::uint64_t render(RenderJob job);
    /// The job fails with kCancelled within 50 ms, unless it is done.
    void cancel(std::uint64_t job);

    /// Runs a short call on the render thread. It must not throw.
    /// \throws Error(kResourceExhausted) if too many wait, Error(kUnavailable) when stopping
    void post(std::function<void()> task);

    /// Ends all views and jobs with kUnavailable, and renders nothing from then on.
    void stop();

    const Backend& backend() const { return backend_; }
    const model::Limits& limits() const { return settings_.limits; }

private:
    struct Entry {
        View view;
        ViewCallbacks callbacks;
        bool loading = false;  ///< what its request needs is being brought; nothing is drawn meanwhile
    };
    struct Running {
        std::uint64_t id = 0;
        bool refines = false;
        double expected_ms = 0;
        std::atomic<bool> cancel{false};
    };
    struct Choice {
        std::shared_ptr<Entry> view;  ///< empty: the job
        std::uint64_t id = 0;
        Step step;
    };
    using Lock = std::unique_lock<std::mutex>;

    /// Whether nothing has to be brought for it.
    bool ready(const model::FrameRequest& request) const;
    void load(std::uint64_t id, const model::FrameRequest& request);
    void loaded(std::uint64_t id, const std::optional<Error>& failure);
    void work();
    bool housekeep(Lock& lock);
    std::optional<Choice> choose(Clock::time_point now);
    std::optional<std::uint64_t> chooseJob() const;
    std::optional<Choice> chooseView(Clock::time_point now, bool interactive);
    void waitForWork(Lock& lock);
    void runView(Lock& lock, Choice choice);
    void encodeView(const Choice& choice, model::Frame frame, double queue_ms);
    void runJob(Lock& lock, std::uint64_t id, const std::shared_ptr<JobProgress>& job);
    void encodeJob(std::shared_ptr<JobProgress> job, model::Frame frame);
    void endView(Lock& lock, std::uint64_t id, const Error& error);
    void refuseWhenStopping() const;

    Backend backend_;
    Settings settings_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool stopping_ = false;
    std::uint64_t last_id_ = 0;
    std::uint64_t served_interactive_ = 0;
    std::uint64_t served_refinement_ = 0;
    bool oldest_job_ = false;  ///< whether the next job is the oldest one, whatever it has taken
    std::map<std::uint64_t, std::shared_ptr<Entry>> views_;
    std::map<std::uint64_t, std::shared_ptr<JobProgress>> jobs_;
    std::deque<std::function<void()>> tasks_;
    std::deque<std::uint64_t> released_;
    std::shared_ptr<Running> running_;
    EncoderPool encoders_;
    Worker loaders_;  ///< ends before what its tasks use
    std::jthread thread_;
};

}  // namespace radiata::session
