#include "render/frame/fiblet_lines.h"

#include <algorithm>
#include <array>
#include <bit>

#include "gpu/device.h"
#include "render/frame/fiblet_line_buffers.h"

namespace radiata::render {
namespace {

struct LayerPush {
    std::uint64_t layer;
};
struct PullPush {
    std::uint64_t layer, slots;
};
struct DecodePush {
    std::uint64_t layer, slots, command;
    std::uint32_t first, count;
};
struct VerticesPush {
    std::uint64_t layer, vertices;
    std::uint32_t first, count;
};
struct TangentsPush {
    std::uint64_t layer, vertices, fibre_first;
};
struct PagesPush {
    std::uint64_t layer;
    std::uint32_t first, end;
};
struct MergePush {
    std::uint64_t layer, image, depth;
};

/// Patches of one draw: llvmpipe of Mesa 25 draws some wrongly of many more.
constexpr double kPatchesAtOnce = 256;
/// Vertices of an instance of pull.vert.
constexpr std::uint32_t kSlotVertices = shader::FIBLET_SEGMENTS + 1;
/// Workgroups of one draw; every device takes 65,535.
constexpr std::uint32_t kPagesAtOnce = 16'384;

}  // namespace

FibletLines::FibletLines(FibletRun& layer) : layer_(layer), run_(layer.run), plan_(layer.plan), own_(layer.own) {}

void FibletLines::begin() {
    Target::Impl& target = run_.target;
    if (!target.fiblet_lines) target.fiblet_lines = std::make_unique<FibletLineBuffers>();
    target.fiblet_lines->prepare(run_.device, static_cast<std::uint32_t>(target.width),
                                 static_cast<std::uint32_t>(target.height), plan_.pipeline);
    if (model::drawsByRasteriser(plan_.pipeline)) run_.recorder.clear(target.fiblet_lines->images);
}

/// Constants 0 to 11 of all these shaders; see there.
std::vector<std::uint32_t> FibletLines::constants(std::uint32_t phase, bool listed, bool counts) const {
    const bool serial = plan_.pipeline == model::FibletPipeline::kMeshSerial;
    return {PassRun::kGroup,
            serial || listed ? 1U : 0U,
            plan_.cuts,
            plan_.states ? 1U : 0U,
            plan_.tubes ? 1U : 0U,
            std::bit_cast<std::uint32_t>(0.5F * static_cast<float>(plan_.line_width_px - 1)),
            phase,
            counts ? 1U : 0U,
            std::bit_cast<std::uint32_t>(static_cast<float>(run_.device.info().line_frame_px)),
            plan_.segments ? 1U : 0U,
            own_.layer().detail_segments > 0 ? 1U : 0U,
            layer_.byCoverage() ? 1U : 0U};
}

const gpu::GraphicsPipeline& FibletLines::pipeline(std::uint32_t phase, bool listed, bool counts) {
    using gpu::ShaderStage;
    const bool serial = plan_.pipeline == model::FibletPipeline::kMeshSerial;
    const bool meshes = serial || plan_.pipeline == model::FibletPipeline::kMesh;
    gpu::Assembly assembly{.primitives = gpu::Primitives::kLineStrips, .line_width = static_cast<float>(plan_.line_width_px)};
    std::vector<std::pair<ShaderStage, std::string>> stages;
    switch (plan_.pipeline) {
        case model::FibletPipeline::kPull:
            stages = {{ShaderStage::kVertex, "fiblet_pull"}};
            if (fewerLines()) assembly.primitives = gpu::Primitives::kLines;
            break;
        case model::FibletPipeline::kLines:
            stages = {{ShaderStage::kVertex, "fiblet_lines"}};
            break;
        case model::FibletPipeline::kGeometry:
            stages = {{ShaderStage::kVertex, "fiblet_number"}, {ShaderStage::kGeometry, "fiblet_strip_geometry"}};
            assembly.primitives = gpu::Primitives::kPointsToLines;
            break;
        case model::FibletPipeline::kTessellation:
            stages = {{ShaderStage::kVertex, "fiblet_number"},
                      {ShaderStage::kTessellationControl, "fiblet_strip_control"},
                      {ShaderStage::kTessellationEvaluation, "fiblet_strip_evaluation"}};
            assembly.primitives = gpu::Primitives::kPatchesToLines;
            break;
        default:
            stages = {
                {ShaderStage::kTask, "fiblet_strip_task"},
                {ShaderStage::kMesh, plan_.mesh_subgroups && !serial ? "fiblet_strip_mesh_subgroups" : "fiblet_strip_mesh"}};
            assembly.primitives = gpu::Primitives::kLines;
    }
    stages.emplace_back(ShaderStage::kFragment, meshes ? "fiblet_line_of_mesh" : "fiblet_line");
    return run_.pipelines.getGraphics(stages, constants(phase, listed, counts), assembly);
}

void FibletLines::draw(bool listed, std::uint32_t first, std::uint32_t end) {
    if (plan_.pipeline == model::FibletPipeline::kPoints) return points();
    gpu::RasterTarget& images = run_.target.fiblet_lines->images;
    run_.recorder.resume(images);
    if (plan_.pipeline == model::FibletPipeline::kLines) {
        strips();
    } else if (plan_.pipeline == model::FibletPipeline::kPull) {
        pull(listed, first, end);
    } else if (plan_.pipeline == model::FibletPipeline::kMesh || plan_.pipeline == model::FibletPipeline::kMeshSerial) {
        meshes(first, end);
    } else {
        const gpu::GraphicsPipeline& drawing = pipeline(0, listed, false);
        while (first < end) {
            run_.checkCancelled();
            const double most = plan_.pipeline == model::FibletPipeline::kTessellation ? kPatchesAtOnce : 4e6;
            const std::uint32_t count = std::min(end - first, static_cast<std::uint32_t>(std::min(layer_.pace.fiblets, most)));
            run_.recorder.drawLines(drawing, "fiblet raster" + layer_.suffix, images, gpu::VertexDraw{first, count, 0, 1},
                                    LayerPush{own_.layerAddress()});
            layer_.submit(count);
            first += count;
        }
    }
    merge();
}

void FibletLines::drawPages(std::uint32_t phase, std::uint32_t first, std::uint32_t end, bool counts) {
    gpu::RasterTarget& images = run_.target.fiblet_lines->images;
    run_.recorder.resume(images);
    const gpu::GraphicsPipeline& drawing = pipeline(phase, false, counts);
    while (first < end) {
        run_.checkCancelled();
        const auto pages = static_cast<std::uint32_t>(std::min(layer_.pace.fiblets / shader::FIBLET_PAGE, 1e6));
        const std::uint32_t count = std::min({end - first, std::max(pages, 1U), kPagesAtOnce});
        run_.recorder.drawLines(drawing, "fiblet raster" + layer_.suffix, images, gpu::MeshDraw{count},
                                PagesPush{own_.layerAddress(), first, 0});
        layer_.submit(std::uint64_t{count} * shader::FIBLET_PAGE);
        first += count;
    }
    merge();
}

void FibletLines::meshes(std::uint32_t first, std::uint32_t end) {
    constexpr std::uint32_t kListed = 4;  // phase of strip.task
    const gpu::GraphicsPipeline& drawing = pipeline(kListed, false, false);
    while (first < end) {
        run_.checkCancelled();
        const auto wanted =
            static_cast<std::uint32_t>(std::min(layer_.pace.fiblets, double{kPagesAtOnce} * shader::FIBLET_PAGE));
        const std::uint32_t count = std::min(end - first, wanted);
        run_.recorder.drawLines(drawing, "fiblet raster" + layer_.suffix, run_.target.fiblet_lines->images,
                                gpu::MeshDraw{PassRun::groups(count)}, PagesPush{own_.layerAddress(), first, first + count});
        layer_.submit(count);
        first += count;
    }
}

void FibletLines::pull(bool listed, std::uint32_t first, std::uint32_t end) {
    FibletLineBuffers& lines = *run_.target.fiblet_lines;
    const gpu::ComputePipeline& decode = run_.pipelines.get("fiblet_decode", constants(0, listed, false));
    const gpu::GraphicsPipeline& drawing = pipeline(0, listed, false);
    // A strip for each slot; or as many lines as decode.comp finds, in the slots' room.
    const double most = fewerLines() ? FibletLineBuffers::kListedFiblets : FibletLineBuffers::kSlots;
    const std::uint64_t given = fewerLines() ? 4 : 0;
    const std::uint32_t number = fewerLines() ? 1 : kSlotVertices;
    while (first < end) {
        run_.checkCancelled();
        const auto wanted = static_cast<std::uint32_t>(std::min(layer_.pace.fiblets, most));
        const std::uint32_t count = std::min(end - first, wanted);
        run_.recorder.fill(lines.command, 0, 16, 0);
        run_.recorder.fill(lines.command, given, 4, number);
        run_.recorder.dispatch(decode, "fiblet decode" + layer_.suffix, PassRun::groups(count), 1, 1,
                               DecodePush{own_.layerAddress(), lines.slots.address(), lines.command.address(), first, count});
        run_.recorder.drawLines(drawing, "fiblet raster" + layer_.suffix, lines.images, gpu::IndirectDraw{&lines.command, 0, 1},
                                PullPush{own_.layerAddress(), lines.slots.address()});
        layer_.submit(count);
        first += count;
    }
}

void FibletLines::strips() {
    const FibreVertices& vertices = *run_.list.layers[layer_.index].vertices;
    const gpu::GraphicsPipeline& drawing = pipeline(0, false, false);
    for (std::uint32_t first = 0; first < vertices.strips();) {
        run_.checkCancelled();
        // As many strips as have the wanted number of points, but one at least.
        const double points = vertices.first()[first] + std::min(layer_.pace.fiblets * shader::FIBLET_SEGMENTS, 2e8);
        const auto next = std::ranges::upper_bound(vertices.first(), points);
        const auto end =
            std::clamp(static_cast<std::uint32_t>(next - vertices.first().begin()) - 1, first + 1, vertices.strips());
        run_.recorder.drawLines(drawing, "fiblet raster" + layer_.suffix, run_.target.fiblet_lines->images,
                                gpu::IndirectDraw{&vertices.commands(), std::uint64_t{first} * 16, end - first},
                                PullPush{own_.layerAddress(), vertices.address()});
        layer_.submit((vertices.first()[end] - vertices.first()[first]) / shader::FIBLET_SEGMENTS + 1);
        first = end;
    }
}

void FibletLines::points() {
    const FibreVertices& vertices = *run_.list.layers[layer_.index].vertices;
    const gpu::ComputePipeline& drawing = run_.pipelines.get(
        "fiblet_points",
        {PassRun::kGroup, plan_.cuts, plan_.states ? 1U : 0U, plan_.tubes ? 1U : 0U, plan_.segments ? 1U : 0U});
    for (std::uint32_t first = 0; first < vertices.count();) {
        run_.checkCancelled();
        const auto wanted = static_cast<std::uint32_t>(std::min(layer_.pace.fiblets, 6e4)) * PassRun::kGroup;
        const std::uint32_t count = std::min(vertices.count() - first, wanted);
        run_.recorder.dispatch(drawing, "fiblet raster" + layer_.suffix, PassRun::groups(count), 1, 1,
                               VerticesPush{own_.layerAddress(), vertices.address(), first, count});
        layer_.submit(count / PassRun::kGroup + 1);
        first += count;
    }
    run_.recorder.dispatch(run_.pipelines.get("fiblet_point_tangents", {PassRun::kGroup}), "fiblet tangents" + layer_.suffix,
                           PassRun::groups(run_.pixels()), 1, 1,
                           TangentsPush{own_.layerAddress(), vertices.address(), vertices.fibreFirstAddress()});
}

void FibletLines::merge() {
    FibletLineBuffers& lines = *run_.target.fiblet_lines;
    run_.recorder.copy(lines.images, lines.words, lines.depth);
    run_.recorder.dispatch(run_.pipelines.get("fiblet_merge", {PassRun::kGroup}), "fiblet merge" + layer_.suffix,
                           PassRun::groups(run_.pixels()), 1, 1,
                           MergePush{own_.layerAddress(), lines.words.address(), lines.depth.address()});
}

}  // namespace radiata::render
