// Runs a frame's plan on the device: each pass in its order, by the file that knows it, submitted in bounded pieces.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <vector>

#include "render/frame/colour_tables.h"
#include "render/frame/fiblet_passes.h"
#include "render/frame/pass_run.h"
#include "render/frame/raster_passes.h"
#include "render/frame/triangle_passes.h"

namespace radiata::render {

/// Of the scenes of fibres that are not all on the device: rises with each sample that is drawn from one of them, whose pages
/// may take the place of those that the picture in a target was drawn from. 0 without such scenes.
std::uint64_t pagesSerial(const DrawList& list);

class Drawer {
public:
    explicit Drawer(gpu::Device& device);

    /// Draws sample `sample` (0: starts the picture anew) into the target's surface buffer and adds its light.
    /// `cancel` is looked at between submissions.
    /// \throws Error(kCancelled), Error of the device
    void drawSample(Target::Impl& target, const DrawList& list, int sample, const std::atomic<bool>* cancel);
    /// Notes whether the target had the same view last. \return whether the texels that it needs at rest are known and done,
    /// too
    bool beginView(Target::Impl& target, DrawList& list, const model::FrameRequest& request);
    /// Goes on with the global light of the picture's first sample, which must be the only one, and lights it anew.
    /// \return whether it is as exact as asked for  \throws as drawSample(); the sample stays
    bool settle(Target::Impl& target, const DrawList& list, std::optional<std::chrono::steady_clock::time_point> until,
                const std::atomic<bool>* cancel);
    /// Mean of the samples to the target's picture.
    void resolve(Target::Impl& target, const DrawList& list);
    /// Runs the traversal of the glyph pass once more over the finished surface buffer, visiting the same boxes and
    /// intersecting nothing, timed as pass "boxes" (for measurements).
    void drawBoxes(Target::Impl& target, const DrawList& list);

    std::vector<gpu::PassTiming> takeTimings() { return recorder_.takeTimings(); }
    gpu::CommandRecorder& recorder() { return recorder_; }
    Pipelines& pipelines() { return pipelines_; }

private:
    void run(PassRun& pass_run, const plan::PassPlan& pass);

    gpu::Device& device_;
    gpu::CommandRecorder recorder_;
    Pipelines pipelines_;
    ColourTables colour_tables_;
    std::uint64_t surfaces_ = 0;  ///< first samples drawn
    BandSize surface_bands_, veil_bands_, path_bands_{1};
    BandSize trace_bands_, uncertainty_bands_, visibility_bands_{1};
    DrawSize boxes_size_, mesh_size_;
    TrianglePace triangle_pace_;
    FibletPace fiblet_pace_;
};

}  // namespace radiata::render
