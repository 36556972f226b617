#include "render/frame/fiblet_coverage.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "render/frame/target.h"

namespace radiata::render {
namespace {

/// Workgroups of one dispatch; every device takes 65,535.
constexpr std::uint32_t kGroupsAtOnce = 16'384;

struct CoveragePush {
    std::uint64_t layer, coverage;
    std::uint32_t first = 0;
};

/// Depth of the farthest corner of the tractogram's box, in place of the paper's far plane.
float farDepth(const FibletScene& scene, const shader::FibletView& view) {
    const glm::dvec3 reference = glm::dvec3(view.reference_high) + glm::dvec3(view.reference_low);
    const glm::dvec3 low = scene.bounds().minimum - scene.set().origin_mm - reference,
                     high = scene.bounds().maximum - scene.set().origin_mm - reference;
    const glm::dvec3 forward(view.forward);
    return static_cast<float>(glm::dot(glm::max(forward * low, forward * high), glm::dvec3(1)));
}

}  // namespace

FibletCoverage::Key FibletCoverage::keyOf(const FibletRun& layer) {
    const shader::FibletLayerParams& params = layer.own.layer();
    Key key{layer.own.scene_serial, params.states, {layer.run.target.width, layer.run.target.height}, {}};
    for (const shader::FibletCut& cut : params.cuts) key.cuts.emplace_back(cut.normal, cut.offset);
    return key;
}

void FibletCoverage::cull(FibletRun& layer) {
    PassRun& run = layer.run;
    const FibletBuffers& own = layer.own;
    const auto texels = [](int pixels) {
        return (pixels + static_cast<int>(shader::FIBLET_TEXEL) - 1) / static_cast<int>(shader::FIBLET_TEXEL);
    };
    const int columns = texels(run.target.width), rows = texels(run.target.height);
    const std::uint64_t bytes = 4 * static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows);
    known_ = known_ && key_ == keyOf(layer) && dilated_.sizeBytes() >= bytes;
    ensureBytes(run.device, params_, sizeof(shader::FibletCoverageParams), gpu::Memory::kUpload, "coverage parameters");
    ensureBytes(run.device, dilated_, bytes, gpu::Memory::kDevice, "coverage");
    ensureBytes(run.device, moved_, bytes, gpu::Memory::kDevice, "moved coverage");
    shader::FibletCoverageParams& coverage = params();
    const shader::FibletView before = coverage.before;
    coverage = {};
    coverage.before = before;
    coverage.now = own.layer().view;
    coverage.dilated = dilated_.address();
    coverage.moved = moved_.address();
    coverage.columns = columns;
    coverage.rows = rows;
    const CoveragePush push{own.layerAddress(), params_.address()};
    if (known_) {
        run.recorder.fill(moved_, 0, bytes, 0);
        run.recorder.dispatch(run.pipelines.get("fiblet_coverage_move", {PassRun::kGroup}),
                              "fiblet coverage move" + layer.suffix, PassRun::groups(bytes / 4), 1, 1, push);
    }
    const auto margin = std::bit_cast<std::uint32_t>(0.5F * static_cast<float>(layer.plan.line_width_px - 1));
    const gpu::ComputePipeline& pipeline =
        run.pipelines.get("fiblet_coverage_cull", {PassRun::kGroup, margin, known_ ? 1U : 0U, layer.plan.tubes ? 1U : 0U});
    for (std::uint32_t group = 0, end = PassRun::groups(layer.scene.fibletCount()); group < end; group += kGroupsAtOnce) {
        run.recorder.dispatch(pipeline, "fiblet coverage cull" + layer.suffix, std::min(end - group, kGroupsAtOnce), 1, 1,
                              CoveragePush{push.layer, push.coverage, group * PassRun::kGroup});
    }
}

void FibletCoverage::remember(FibletRun& layer) {
    PassRun& run = layer.run;
    const FibletBuffers& own = layer.own;
    known_ = own.level_offsets.size() >= shader::FIBLET_TEXEL_LEVEL;
    if (!known_) return;  // a picture of a few pixels
    shader::FibletCoverageParams& coverage = params();
    coverage.before = own.layer().view;
    coverage.depths = own.pyramid.address() + 4 * std::uint64_t{own.level_offsets[shader::FIBLET_TEXEL_LEVEL - 1]};
    coverage.reach = static_cast<float>(shader::FIBLET_SEGMENTS) * layer.scene.set().codec.step_mm;
    coverage.far_depth = farDepth(layer.scene, coverage.before);
    key_ = keyOf(layer);
    const std::uint64_t texels = static_cast<std::uint64_t>(coverage.columns) * static_cast<std::uint64_t>(coverage.rows);
    run.recorder.fill(dilated_, 0, 4 * texels, 0);
    run.recorder.dispatch(run.pipelines.get("fiblet_coverage_dilate", {PassRun::kGroup}),
                          "fiblet coverage dilate" + layer.suffix, PassRun::groups(texels), 1, 1,
                          CoveragePush{own.layerAddress(), params_.address()});
}

}  // namespace radiata::render
