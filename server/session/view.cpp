#include "session/view.h"

#include <algorithm>
#include <string>

#include "base/error.h"

namespace radiata::session {
namespace {

constexpr int kFirstRefined = 4;  // samples in the first refining picture that is sent; each later one has twice as many

/// Samples at which the next picture is sent.
int nextStop(int done, int total) {
    int stop = kFirstRefined;
    while (stop <= done) stop *= 2;
    return std::min(stop, total);
}

bool sameEcho(const model::FrameRequest& a, const model::FrameRequest& b) {
    return a.scene == b.scene && a.quality == b.quality && a.width == b.width && a.height == b.height;
}

}  // namespace

View::View(model::FrameRequest request, int window, Pace pace, Clock::time_point now)
    : request_(std::move(request)), window_(window), pace_(pace), changed_at_(now) {}

model::FrameRequest View::merged(const Change& change) const {
    model::FrameRequest request = request_;
    // Unary calls may overtake each other: a part that is older than the one in force is left out.
    if (change.camera && change.camera_sequence >= applied_.camera) request.camera = *change.camera;
    if (change.scene && change.camera_sequence >= applied_.scene) request.scene = *change.scene;
    if (change.quality && change.camera_sequence >= applied_.quality) request.quality = *change.quality;
    if (change.size && change.camera_sequence >= applied_.size) {
        request.width = change.size->width;
        request.height = change.size->height;
    }
    return request;
}

bool View::apply(const Change& change, Clock::time_point now) {
    if (change.acknowledged_sequence > sent_) {
        throw Error(Code::kInvalidArgument, "acknowledged_sequence is " + std::to_string(change.acknowledged_sequence) +
                                                "; the newest frame sent is " + std::to_string(sent_));
    }
    model::FrameRequest request = merged(change);
    acknowledged_ = std::max(acknowledged_, change.acknowledged_sequence);
    const auto stamp = [&change](std::uint64_t& applied, bool present) {
        if (present) applied = std::max(applied, change.camera_sequence);
    };
    stamp(applied_.camera, change.camera.has_value());
    stamp(applied_.scene, change.scene.has_value());
    stamp(applied_.quality, change.quality.has_value());
    stamp(applied_.size, change.size.has_value());
    const bool different = !(request == request_);
    // The same picture is drawn again only if the client waits for an answer to a newer number.
    const bool asks = change.camera || change.scene || change.quality || change.size;
    const bool newer = asks && change.camera_sequence > camera_sequence_;
    if (!different && !newer) return false;
    request_ = std::move(request);
    if (change.camera_sequence >= camera_sequence_) {
        camera_sequence_ = change.camera_sequence;
        client_time_ms_ = change.client_time_ms;
    }
    changed_at_ = now;
    ++revision_;
    return true;
}

int View::underWay() const { return pending_ + static_cast<int>(sent_ - acknowledged_); }

std::optional<Step> View::next(Clock::time_point now) const {
    if (working_ || underWay() >= window_) return std::nullopt;
    Step step;
    step.revision = revision_;
    step.camera_sequence = camera_sequence_;
    step.client_time_ms = client_time_ms_;
    step.arrival = changed_at_;
    step.ordinal = ordinal_ + 1;
    if (interactivePending()) {
        step.interactive = true;
        return step;
    }
    if (converged_ || now < changed_at_ + pace_.rest_delay) return std::nullopt;
    const int total = request_.quality.samples;
    // With one sample in all, the finished picture is the interactive one once more, this time without loss.
    step.first_sample = samples_done_ >= total ? 0 : samples_done_;
    const int stop = nextStop(step.first_sample, total);
    const double budget = static_cast<double>(pace_.step_budget.count());
    const int affordable = sample_ms_ > 0 ? static_cast<int>(std::clamp(budget / sample_ms_, 1.0, 64.0)) : 1;
    step.count = std::min(stop - step.first_sample, affordable);
    const int done = step.first_sample + step.count;
    step.emits = done == stop;
    step.state = done == total ? model::FrameState::kConverged : model::FrameState::kRefining;
    return step;
}

std::optional<Clock::time_point> View::wakeAt() const {
    if (working_ || underWay() >= window_ || converged_ || interactivePending()) return std::nullopt;
    return changed_at_ + pace_.rest_delay;
}

void View::started(const Step& step) {
    working_ = true;
    ordinal_ = step.ordinal;
    if (step.emits) ++pending_;
}

bool View::rendered(const Step& step, double render_ms, std::optional<int> samples) {
    working_ = false;
    sample_ms_ = std::max(render_ms / step.count, 1e-3);
    if (step.interactive) {
        shown_revision_ = step.revision;
        samples_done_ = 1;
        converged_ = false;
        return true;
    }
    if (step.revision != revision_) {
        if (step.emits) --pending_;
        return false;
    }
    samples_done_ = samples.value_or(step.first_sample + step.count);
    converged_ = step.state == model::FrameState::kConverged;
    return step.emits;
}

void View::cancelled(const Step& step) {
    working_ = false;
    if (step.emits) --pending_;
    samples_done_ = 0;  // what a cancelled step left in the target is not known
}

bool View::offer(StreamFrame frame, const Step& step) {
    // Pictures are encoded side by side and may overtake each other.
    if (step.ordinal <= offered_ordinal_) {
        --pending_;
        return false;
    }
    if (ready_) --pending_;
    offered_ordinal_ = step.ordinal;
    ready_arrival_ = step.arrival;
    ready_ = std::move(frame);
    return true;
}

const model::FrameRequest& View::requestOf(std::uint64_t sequence) const {
    if (sequence == 0 || sequence > sent_) {
        throw Error(Code::kNotFound, "frame " + std::to_string(sequence) + " was never sent; the newest of this view is " +
                                         std::to_string(sent_));
    }
    const std::uint64_t age = sent_ - sequence;
    if (age >= sent_requests_.size()) {
        throw Error(Code::kNotFound, "frame " + std::to_string(sequence) + " is too old: this view has sent " +
                                         std::to_string(sent_) + " and the last " + std::to_string(kFramesKept) +
                                         " are known; pick on the picture that is shown");
    }
    return sent_requests_[sent_requests_.size() - 1 - static_cast<std::size_t>(age)];
}

std::optional<StreamFrame> View::take(Clock::time_point now) {
    if (!ready_) return std::nullopt;
    std::optional<StreamFrame> frame = std::move(ready_);
    ready_.reset();
    --pending_;
    frame->sequence = ++sent_;
    sent_requests_.push_back(frame->info.request);
    if (sent_requests_.size() > kFramesKept) sent_requests_.pop_front();
    frame->timing.total_ms = std::chrono::duration<double, std::milli>(now - ready_arrival_).count();
    frame->echo_request = !echoed_ || !sameEcho(*echoed_, frame->info.request);
    if (frame->echo_request) echoed_ = frame->info.request;
    return frame;
}

}  // namespace radiata::session
