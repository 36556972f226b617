// One finished picture for one request: the work behind RenderService.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>

#include "base/error.h"
#include "session/stream_frame.h"
#include "session/view.h"

namespace radiata::session {

struct RenderJob {
    model::FrameRequest request;
    model::Outputs outputs;
    ImageFormat format = ImageFormat::kPng;
    /// Called exactly once, by any thread, with no lock held. May throw nothing.
    std::function<void(StreamFrame)> done;
    std::function<void(const Error&)> failed;
};

/// A job between its steps: drawn in small batches, so that views go on meanwhile.
struct JobProgress {
    RenderJob job;
    Clock::time_point arrival;
    std::optional<Clock::time_point> begin;
    std::atomic<bool> cancel{false};
    bool loading = false;  ///< its datasets are being read
    int samples_done = 0;
    double sample_ms = 0;
    double render_ms = 0;
    bool has_outputs = false;
    model::FramePixels outputs;  ///< of the first sample

    /// Samples of the next batch; 0: a slice of the light of a picture of one sample.
    int nextCount(std::chrono::milliseconds budget) const {
        if (job.request.quality.samples == 1 && job.request.scene.light.illumination) return 0;
        const int left = job.request.quality.samples - samples_done;
        const int affordable =
            sample_ms > 0 ? static_cast<int>(std::clamp(static_cast<double>(budget.count()) / sample_ms, 1.0, 64.0)) : 1;
        return std::min(left, affordable);
    }

    /// How often its time has doubled beyond a second: of jobs that wait, those of which this is least go first.
    int level() const { return static_cast<int>(std::log2(1 + render_ms / 1000)); }
};

}  // namespace radiata::session
