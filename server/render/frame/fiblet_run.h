// One layer of fiblets while its passes run: what they all read, and how much each submission may have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "plan/plan_fiblets.h"
#include "render/frame/fiblet_buffers.h"
#include "render/frame/pass_run.h"

namespace radiata::render {

/// Fiblets per submission, adapted to the last measured speed.
struct FibletPace {
    static constexpr double kSubmissionMs = 30;
    double fiblets = 4096;

    /// \param drawn  fiblets of a submission \param took_ms  its time
    void learn(std::uint64_t drawn, double took_ms);
};

struct FibletRun {
    /// \param first_layer  nothing is in the surface buffer, or peel surface, yet
    FibletRun(PassRun& pass_run, std::size_t layer, bool first_layer, FibletPace& fiblet_pace);

    PassRun& run;
    FibletPace& pace;
    std::size_t index;
    const plan::FibletPlan& plan;
    const FibletScene& scene;
    FibletBuffers& own;
    bool first;
    std::string suffix;  ///< of the passes' names

    /// Room in buffers, and all parameters of the layer for one sample of a camera, or of another that it is culled for.
    /// \param rays, reference_mm  the camera's
    void prepare(const shader::CameraRays& rays, const glm::dvec3& reference_mm);
    /// By what prepare() was told; nothing is drawn of a layer without fiblets.
    bool mayBeSeen() const { return scene.fibletCount() > 0 && run.list.camera.sees_scene; }
    /// Submits, and learns from the time how many fiblets the next submission may have.
    void submit(std::uint64_t fiblets);
    /// Constants of a pipeline that has one more where not all fiblets are on the device.
    std::vector<std::uint32_t> withPaged(std::vector<std::uint32_t> constants) const;

    bool byCoverage() const { return plan.culling == model::FibletCulling::kCoverage; }
    bool inTwoPhases() const { return plan.culling == model::FibletCulling::kTwoPhase; }
};

}  // namespace radiata::render
