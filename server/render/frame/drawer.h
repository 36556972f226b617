// Runs a frame's plan on the device: fills parameters, records the passes, submits them in bounded pieces.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "gpu/recorder.h"
#include "plan/camera_rays.h"
#include "plan/plan.h"
#include "render/frame/colour_tables.h"
#include "render/frame/pipelines.h"
#include "render/frame/target.h"
#include "render/glyph/glyph_scene.h"

namespace radiata::render {

/// What is drawn: one glyph scene per layer of the plan, all with the same centre.
struct DrawList {
    const plan::FramePlan* plan = nullptr;
    std::vector<GlyphScene*> layers;
    std::vector<std::shared_ptr<const store::ScalarDataset>> scalars;  ///< of the layers coloured so; others have none
    plan::RebasedCamera camera;
    glm::dvec3 light_direction_world{0, 0, 1};
};

class Drawer {
public:
    explicit Drawer(gpu::Device& device);

    /// Draws sample `sample` (0: starts the picture anew) into the target's surface buffer and adds its light.
    /// Each submission is sized to take about kSubmissionMs; `cancel` is looked at between them.
    /// \throws Error(kCancelled), Error of the device
    void drawSample(Target::Impl& target, const DrawList& list, int sample, const std::atomic<bool>* cancel);
    /// Mean of the samples to the target's picture.
    void resolve(Target::Impl& target);
    /// Runs the traversal of the glyph pass once more over the finished surface buffer, visiting the same boxes and
    /// intersecting nothing, timed as pass "boxes" (for measurements).
    void drawBoxes(Target::Impl& target, const DrawList& list);

    std::vector<gpu::PassTiming> takeTimings() { return recorder_.takeTimings(); }
    gpu::CommandRecorder& recorder() { return recorder_; }
    Pipelines& pipelines() { return pipelines_; }

    static constexpr double kSubmissionMs = 20;
    static constexpr int kTileShiftX = 2, kTileShiftY = 1;

private:
    void prepareCamera(Target::Impl& target, const DrawList& list);
    shader::LayerLook layerLook(const DrawList& list, std::size_t layer);
    void trace(Target::Impl& target, const DrawList& list, std::size_t layer, bool boxes_only, const std::atomic<bool>* cancel);

    gpu::Device& device_;
    gpu::CommandRecorder recorder_;
    Pipelines pipelines_;
    ColourTables colour_tables_;
    double rows_per_submission_ = 8;  ///< blocks of 8 pixel rows, adapted to the last measured speed
};

}  // namespace radiata::render
