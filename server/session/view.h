// One open view as a state machine: what it wants, how far it has come, what may be drawn next, what may be sent.
// It knows no threads, no clock and no renderer; Conductor calls it under its lock.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

#include "session/change.h"
#include "session/stream_frame.h"

namespace radiata::session {

using Clock = std::chrono::steady_clock;

/// A piece of work for the render thread.
struct Step {
    bool interactive = false;  ///< answers a change; otherwise it refines a view at rest
    int first_sample = 0;
    int count = 1;
    bool emits = true;  ///< whether its picture is sent
    model::FrameState state = model::FrameState::kInteractive;
    std::uint64_t revision = 0;  ///< of the request it draws
    std::uint64_t ordinal = 0;   ///< rises with each step of the view
    std::uint64_t camera_sequence = 0;
    double client_time_ms = 0;
    Clock::time_point arrival;
};

struct Pace {
    std::chrono::milliseconds rest_delay{120};   ///< without a change, before refinement starts
    std::chrono::milliseconds step_budget{100};  ///< aim for one step of refinement
};

class View {
public:
    View(model::FrameRequest request, int window, Pace pace, Clock::time_point now);

    const model::FrameRequest& request() const { return request_; }
    /// The request as it would be after the change. Parts older than what was applied already stay out.
    model::FrameRequest merged(const Change& change) const;
    /// Takes over a change. \return whether there is something new to draw.
    /// \throws Error(kInvalidArgument) if it acknowledges a frame that was never sent; the view stays as it was
    bool apply(const Change& change, Clock::time_point now);

    /// What to draw next. A resting view has work only after its delay, a view out of window or in work has none.
    std::optional<Step> next(Clock::time_point now) const;
    /// When next() will have refinement to offer if nothing else happens.
    std::optional<Clock::time_point> wakeAt() const;
    void started(const Step& step);
    /// \param samples  in the picture, fewer than the step's while its light is still being worked on; none: all of them
    /// \return whether the picture is to be encoded and offered.
    bool rendered(const Step& step, double render_ms, std::optional<int> samples = {});
    void cancelled(const Step& step);

    /// A picture of an emitting step is ready to go; replaces an older one that has not gone. \return whether it was kept
    bool offer(StreamFrame frame, const Step& step);
    /// The newest frame that has not gone yet.
    std::optional<StreamFrame> take(Clock::time_point now);

    /// What a frame that was sent was drawn from; the last kFramesKept are known.
    /// \throws Error(kNotFound) for an older one, or one that was never sent
    const model::FrameRequest& requestOf(std::uint64_t sequence) const;
    static constexpr std::size_t kFramesKept = 64;

    /// Frames drawn or sent that the client has not acknowledged.
    int underWay() const;
    bool interactivePending() const { return revision_ != shown_revision_; }
    std::uint64_t revision() const { return revision_; }
    double sampleMs() const { return sample_ms_; }

private:
    struct Applied {
        std::uint64_t camera = 0, scene = 0, quality = 0, size = 0;
    };

    model::FrameRequest request_;
    int window_;
    Pace pace_;
    std::uint64_t revision_ = 1;
    std::uint64_t shown_revision_ = 0;
    std::uint64_t camera_sequence_ = 0;
    double client_time_ms_ = 0;
    Applied applied_;
    Clock::time_point changed_at_;

    bool working_ = false;
    int samples_done_ = 0;
    bool converged_ = false;
    double sample_ms_ = 0;
    std::uint64_t ordinal_ = 0;

    int pending_ = 0;  ///< pictures between the start of their step and their hand-over
    std::uint64_t offered_ordinal_ = 0;
    std::uint64_t sent_ = 0;
    std::deque<model::FrameRequest> sent_requests_;  ///< of the newest frames, the last one that of sent_
    std::uint64_t acknowledged_ = 0;
    std::optional<StreamFrame> ready_;
    Clock::time_point ready_arrival_;
    std::optional<model::FrameRequest> echoed_;
};

}  // namespace radiata::session
