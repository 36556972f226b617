#include "session/stub_backend.h"

#include <cmath>
#include <numbers>
#include <thread>

#include "base/error.h"
#include "math/sh_evaluate.h"
#include "math/sh_layout.h"

namespace radiata::session {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kId = "stub";
constexpr double kHalfSide_mm = 90;

model::DatasetInfo dataset() {
    model::DatasetInfo info;
    info.id = kId;
    info.size = {90, 90, 90};
    info.layout = ShLayout{8, false};
    info.voxel_to_world = glm::dmat4(2.0);
    info.voxel_to_world[3] = glm::dvec4(-kHalfSide_mm, -kHalfSide_mm, -kHalfSide_mm, 1);
    info.glyph_count = 20'000;
    info.amplitude_max = 1;
    info.bounds_min = glm::dvec3(-kHalfSide_mm);
    info.bounds_max = glm::dvec3(kHalfSide_mm);
    return info;
}

model::DatasetInfo lookUp(const std::string& id) {
    if (id != kId) throw Error(Code::kNotFound, "dataset \"" + id + "\" is not in the catalogue; \"stub\" is all there is");
    return dataset();
}

void rest(std::chrono::milliseconds time, const std::atomic<bool>* cancel) {
    const auto end = Clock::now() + time;
    constexpr auto kSlice = std::chrono::milliseconds(5);
    for (auto now = Clock::now(); now < end; now = Clock::now()) {
        if (cancel && *cancel) throw Error(Code::kCancelled, "the picture is not wanted any more");
        std::this_thread::sleep_for(std::min<Clock::duration>(kSlice, end - now));
    }
    if (cancel && *cancel) throw Error(Code::kCancelled, "the picture is not wanted any more");
}

void paint(model::FramePixels& pixels, const model::FrameRequest& request, int samples) {
    const glm::dvec3 eye = request.camera.eye_mm - request.camera.target_mm;
    const auto turn = static_cast<int>(std::lround(std::atan2(eye.y, eye.x) / (2 * std::numbers::pi) * 256 + eye.z));
    pixels.rgba.resize(static_cast<std::size_t>(request.width) * static_cast<std::size_t>(request.height) * 4);
    std::uint8_t* out = pixels.rgba.data();
    for (int y = 0; y < request.height; ++y) {
        for (int x = 0; x < request.width; ++x, out += 4) {
            out[0] = static_cast<std::uint8_t>((x + turn) & 255);
            out[1] = static_cast<std::uint8_t>((y - turn) & 255);
            out[2] = static_cast<std::uint8_t>(samples * 3);
            out[3] = 255;
        }
    }
}

void fillOutputs(model::FramePixels& pixels, const model::Outputs& outputs) {
    const std::size_t count = static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height);
    if (outputs.depth) pixels.depth.assign(count, 1.5F);
    if (outputs.id) pixels.id.assign(count * 4, -1);
    if (outputs.position) pixels.position.assign(count * 3, std::nanf(""));
    if (outputs.normal) pixels.normal.assign(count * 3, 0.0F);
    if (outputs.steps) pixels.steps.assign(count, 0);
}

model::Frame draw(std::chrono::milliseconds sample_time, const model::FrameRequest& request, int first_sample, int count,
                  const model::Outputs& outputs, const std::atomic<bool>* cancel) {
    const auto start = Clock::now();
    for (const model::Layer& layer : request.scene.layers) lookUp(layer.datasetId());
    rest(sample_time * count, cancel);
    model::Frame frame;
    frame.info.request = request;
    frame.info.samples = first_sample + count;
    frame.info.traversal_reason = "nothing is traversed";
    frame.info.pole_table_reason = "nothing is traced";
    frame.info.glyphs = frame.info.glyphs_available = dataset().glyph_count;
    for (std::size_t i = 0; i < request.scene.layers.size(); ++i) {
        const model::GlyphLayer* glyphs = request.scene.layers[i].ifGlyphs();
        model::LeftOut left_out{static_cast<int>(i), dataset().layout.lmax, dataset().layout.lmax, 0, 0, 0};
        if (glyphs != nullptr) left_out.lmax = glyphs->lmax.value_or(left_out.lmax);
        if (left_out.anything()) frame.info.left_out.push_back(left_out);
    }
    frame.info.device = "stub";
    frame.pixels.width = request.width;
    frame.pixels.height = request.height;
    paint(frame.pixels, request, frame.info.samples);
    fillOutputs(frame.pixels, outputs);
    frame.info.render_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    frame.info.passes.push_back({"paint", "stub", frame.info.render_ms});
    return frame;
}

/// The left half of the picture is one glyph with two lobes along y; the right half is empty.
std::optional<model::Picked> pick(const model::FrameRequest& request, int x, int y, int /*radius_px*/, bool all_hits) {
    const std::string& id = request.scene.layers[0].datasetId();
    const model::DatasetInfo info = lookUp(id);
    if (2 * x >= request.width) return std::nullopt;
    model::PickedGlyph glyph;
    glyph.dataset_id = id;
    glyph.voxel = {x, y, 0};
    glyph.centre_mm = glm::dvec3(info.voxel_to_world * glm::dvec4(glm::dvec3(glyph.voxel), 1.0));
    glyph.direction = {0, 0.6, 0.8};
    glyph.layout = ShLayout{2, false};
    glyph.coefficients = {1, -0.5F, 0, 0, 0, 0};  // f = 0.282 - 0.273 (x^2 - y^2)
    glyph.amplitude = evaluateSh(glyph.layout, glyph.coefficients, glyph.direction);
    glyph.radius_mm = 2 * glyph.amplitude;
    glyph.position_mm = glyph.centre_mm + glyph.radius_mm * glyph.direction;
    // A ray through the centre, from 100 mm in front of the first hit.
    for (const double side : {1.0, -1.0}) {
        if (!all_hits) break;
        glyph.hits.push_back({100 + (1 - side) * glyph.radius_mm, glyph.centre_mm + side * glyph.radius_mm * glyph.direction,
                              side * glyph.direction, glyph.radius_mm, false, side < 0});
    }
    return glyph;
}

model::Camera fit(const std::string& id, const model::VoxelSelection& selection, model::Convention convention, double aspect) {
    const model::DatasetInfo info = lookUp(id);
    const double distance = 4 * kHalfSide_mm;
    const bool mirrored = convention == model::Convention::kNeurological;
    model::Camera camera;
    camera.target_mm = (info.bounds_min + info.bounds_max) / 2.0;
    camera.height_mm = 2 * kHalfSide_mm * std::max(1.0, 1 / aspect);
    glm::dvec3 towards_eye(0, 0, mirrored ? distance : -distance);
    camera.up = {0, 1, 0};
    if (selection.plane == model::Plane::kCoronal) towards_eye = {0, mirrored ? -distance : distance, 0};
    if (selection.plane == model::Plane::kSagittal) towards_eye = {-distance, 0, 0};
    if (selection.plane == model::Plane::kCoronal || selection.plane == model::Plane::kSagittal) camera.up = {0, 0, 1};
    camera.eye_mm = camera.target_mm + towards_eye;
    return camera;
}

}  // namespace

Backend stubBackend(std::chrono::milliseconds sample_time) {
    Backend backend;
    backend.render = [sample_time](std::uint64_t, const model::FrameRequest& request, int first_sample, int count,
                                   const model::Outputs& outputs, const std::atomic<bool>* cancel) {
        return draw(sample_time, request, first_sample, std::max(count, 1), outputs, cancel);
    };
    backend.release = [](std::uint64_t) {};
    backend.fit_camera = fit;
    backend.pick = pick;
    backend.pick_fibres = [](const model::FrameRequest&, const std::vector<glm::dvec2>&, bool) {
        return std::vector<model::PickedFibres>();
    };
    backend.list = [] { return std::vector<model::DatasetInfo>{dataset()}; };
    backend.info = lookUp;
    backend.select = [](const std::string& id, const std::string&) -> model::SelectedFibres {
        lookUp(id);
        throw Error(Code::kInvalidArgument, "dataset \"" + id + "\" is no tractogram");
    };
    backend.write_fibres = [](const std::string& id, const std::string&,
                              const std::filesystem::path&) -> std::vector<std::filesystem::path> {
        lookUp(id);
        throw Error(Code::kInvalidArgument, "dataset \"" + id + "\" is no tractogram");
    };
    backend.resident = [](const model::FrameRequest& request) {
        for (const model::Layer& layer : request.scene.layers) lookUp(layer.datasetId());
        return true;
    };
    backend.load = [](const model::FrameRequest&) {};
    backend.device = "stub";
    return backend;
}

}  // namespace radiata::session
