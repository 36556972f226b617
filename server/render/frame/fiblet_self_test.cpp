#include "render/frame/fiblet_self_test.h"

#include <cmath>

#include "base/error.h"
#include "build/fiblet_encode.h"
#include "gpu/device.h"
#include "render/frame/known_picture.h"

namespace radiata::render {
namespace {

// One pixel a millimetre. Fibres begin and end outside of the picture, as some drivers clip lines to wrong places, and advance
// by one pixel with each segment.
constexpr int kSize = 80, kMargin = -6, kSegments = kSize - 2 * kMargin;  // more than one fiblet each
constexpr float kStart = 0.25F;
constexpr double kSlope = 0.05;      // of the zigzags
constexpr double kUndecided = 0.05;  // mm between fibres that cross

/// Height over the picture's plane of fibre `k` of a direction at point `i`.
double heightAt(int k, int direction, int i) {
    const int run = 3 + (k + 2 * direction) % 5;
    double height = 0.4 * ((7 * k + 3 * direction) % 11);
    for (int step = 0; step < i; ++step) height += step / run % 2 == 0 ? kSlope : -kSlope;
    return height;
}

model::FibletSet lattice() {
    std::vector<glm::vec3> points;
    std::vector<std::uint64_t> offsets{0};
    for (int direction = 0; direction < 2; ++direction) {
        for (int k = 0; k < kSegments; ++k) {
            for (int i = 0; i <= kSegments; ++i) {
                const glm::vec2 place(static_cast<float>(kMargin + i) + kStart, static_cast<float>(kMargin + k) + 0.5F);
                const auto height = static_cast<float>(heightAt(k, direction, i));
                points.emplace_back(direction == 0 ? place.x : place.y, direction == 0 ? place.y : place.x, height);
            }
            offsets.push_back(points.size());
        }
    }
    return encodeFiblets(points, offsets, {});
}

model::FrameRequest latticeRequest(model::FibletPipeline pipeline) {
    model::FrameRequest request;
    request.width = request.height = kSize;
    request.quality.samples = 1;
    request.quality.fiblet_pipeline = pipeline;
    request.scene.layers.emplace_back().content = model::TractogramLayer{};
    // Rows count downwards: they are the y axis of a picture whose up is -y, seen from -z; nearer is lower.
    request.camera.eye_mm = {0.5 * kSize, 0.5 * kSize, -100};
    request.camera.target_mm = {0.5 * kSize, 0.5 * kSize, 0};
    request.camera.up = {0, -1, 0};
    request.camera.perspective = false;
    request.camera.height_mm = kSize;
    return request;
}

bool latticeIsRight(const model::FramePixels& pixels, double depth_offset) {
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const int column = x - kMargin, row = y - kMargin;
            const std::size_t at = static_cast<std::size_t>(y) * kSize + static_cast<std::size_t>(x);
            if (pixels.id[4 * at] < 0) return false;
            const double across = heightAt(row, 0, column), along = heightAt(column, 1, row);
            if (std::abs(across - along) < kUndecided) continue;
            const bool first = across < along;
            if (pixels.id[4 * at + 1] != (first ? row : kSegments + column)) return false;
            if (pixels.id[4 * at + 2] != (first ? column : row)) return false;
            // Points decode to within 10 um, and pixels' centres are a quarter of a segment behind them.
            const double depth = static_cast<double>(pixels.depth[at]) + depth_offset;
            if (std::abs(depth - 100 - std::min(across, along)) > 0.02 + 0.25 * kSlope) return false;
        }
    }
    return true;
}

/// What the device says that it can do for fibres.
void addFibreAbilities(const gpu::Device& device, plan::Abilities& abilities) {
    using gpu::Feature;
    abilities.int64_atomics = device.has(Feature::kInt64Atomics);
    abilities.lines = device.has(Feature::kRaster) && device.has(Feature::kLines);
    abilities.line_width_max = device.info().line_width_max;
    abilities.mesh_shader = device.has(Feature::kMeshShader);
    abilities.mesh_subgroups = device.has(Feature::kMeshSubgroups);
    abilities.geometry_shader = device.has(Feature::kGeometryShader);
    abilities.tessellation_shader = device.has(Feature::kTessellationShader);
}

}  // namespace

FibreSelfTest::FibreSelfTest(gpu::Device& device, Drawer& drawer, plan::Abilities& abilities)
    : device_(device), drawer_(drawer), abilities_(abilities) {
    addFibreAbilities(device, abilities);
}

bool FibreSelfTest::works(Pipeline pipeline) {
    try {
        const model::FrameRequest request = latticeRequest(pipeline);
        if (!scene_) scene_ = std::make_shared<const FibletScene>(device_, std::make_shared<const model::FibletSet>(lattice()));
        DrawnLayer layer;
        layer.tracts = scene_;
        const model::TractogramLayer& looks = request.scene.layers[0].tracts();
        FibreSelector selector(std::shared_ptr<const model::FibletSet>(scene_, &scene_->set()), {}, {});
        layer.fibres = FibreLook{std::make_shared<const FibreFilter>(device_, scene_->set(), looks, selector),
                                 std::make_shared<const FibreColours>(device_, scene_->set(), looks.colour, selector)};
        if (model::drawsUncompressed(pipeline)) {
            layer.vertices = std::make_shared<const FibreVertices>(device_, scene_->set());
        }
        layer.bounds = scene_->bounds();
        const auto facts = [](const auto&) { return plan::LayerFacts{}; };
        const KnownPicture picture = drawKnownPicture(device_, drawer_, request, layer, facts, abilities_);
        return latticeIsRight(picture.pixels, picture.depth_offset_mm);
    } catch (const Error&) {
        return false;
    }
}

void FibreSelfTest::test(Pipeline wanted) {
    if (wanted == Pipeline::kAuto) {
        test(Pipeline::kAtomic);
        if (failed(Pipeline::kAtomic)) test(Pipeline::kPull);
        return;
    }
    if ((tested_ & bit(wanted)) != 0) return;
    tested_ |= bit(wanted);
    if (!works(wanted)) abilities_.failed_pipelines |= bit(wanted);
}

std::vector<std::string> FibreSelfTest::testAll() {
    std::vector<std::string> names;
    for (const Pipeline one : {Pipeline::kAtomic, Pipeline::kPull, Pipeline::kMesh, Pipeline::kMeshSerial, Pipeline::kGeometry,
                               Pipeline::kTessellation, Pipeline::kLines, Pipeline::kPoints}) {
        test(one);
        if (!failed(one)) names.emplace_back(model::pipelineName(one));
    }
    scene_.reset();
    return names;
}

}  // namespace radiata::render
