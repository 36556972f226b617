#include "render/frame/path_passes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "gpu/device.h"
#include "math/low_discrepancy.h"
#include "render/frame/isosurface_passes.h"
#include "shaders/shared/lattice.glsl"
#include "shaders/shared/pixel_paths.glsl"

namespace radiata::render {
namespace {

using Clock = std::chrono::steady_clock;

/// Paths of each replicate that a moving picture has, and before which no error counts.
constexpr std::uint32_t kFirstPaths = 1;
constexpr std::uint32_t kLeastPaths = 8;
constexpr std::uint32_t kSeed = 0x9a7457acU;

struct PathsPush {
    std::uint64_t frame, layer, surface, lattice, paths, light;
    std::uint32_t path, least;
    float relative_error;
    std::uint32_t seed, first_block_row;
};

const model::Illumination& lightOf(const DrawList& list) { return *list.plan->resolved.scene.light.illumination; }

double samplesOf(const DrawList& list) { return static_cast<double>(list.plan->resolved.quality.samples); }

/// Of each replicate in one sample of the picture, a power of two: all samples together have what is asked for of a pixel.
std::uint32_t pathsMax(const DrawList& list) {
    const double share = lightOf(list).samples_max / samplesOf(list) / shader::LATTICE_REPLICATES;
    return std::bit_floor(std::max(static_cast<std::uint32_t>(share), kFirstPaths));
}

/// Errors of samples are independent, so each may be that much larger than the picture's.
float wantedError(const DrawList& list) {
    return lightOf(list).relative_error * static_cast<float>(std::sqrt(samplesOf(list)));
}

/// One path more of each replicate, in all of the layer's pixels.
void addPath(PassRun& run, const plan::PassPlan& pass, std::uint32_t path, BandSize& bands) {
    const auto layer = static_cast<std::size_t>(pass.layer);
    run.dispatchBands(
        run.pipelines.get(pass.shader, {PassRun::kGroup}), pass.name,
        PathsPush{run.frameAddress(), isosurfaceAddress(run.target, layer), run.target.surface.address(),
                  run.list.layers[layer].path_light->address(), run.target.paths.address(), run.target.global_light.address(),
                  path, kLeastPaths, wantedError(run.list), childSeed(kSeed, static_cast<std::uint32_t>(run.sample)), 0},
        bands);
}

/// Of the latest sample, the pixels that show a layer whose pixels are path-traced.
std::vector<shader::PixelPaths> litPixels(gpu::Device& device, const Target::Impl& target, const DrawList& list) {
    const std::size_t pixels = static_cast<std::size_t>(target.width) * static_cast<std::size_t>(target.height);
    std::vector<shader::PixelPaths> paths(pixels);
    std::vector<shader::Surface> surfaces(pixels);
    gpu::download(device, target.paths, 0, std::as_writable_bytes(std::span(paths)));
    gpu::download(device, target.surface, 0, std::as_writable_bytes(std::span(surfaces)));
    std::uint32_t traced = 0;  // layers
    for (const plan::PassPlan& pass : list.plan->passes) {
        if (pass.kind == plan::PassKind::kPixelPaths) traced |= 1U << static_cast<std::uint32_t>(pass.layer);
    }
    std::size_t lit = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (surfaces[i].who == 0xffffffffU || (traced >> (surfaces[i].layer_and_steps >> 24U) & 1U) == 0) continue;
        paths[lit++] = paths[i];
    }
    paths.resize(lit);
    return paths;
}

std::uint64_t followed(const shader::PixelPaths& paths) { return std::uint64_t{paths.count} * shader::LATTICE_REPLICATES; }

}  // namespace

void runPixelPaths(PassRun& run, const plan::PassPlan& pass, BandSize& bands) {
    ensureBytes(run.device, run.target.global_light, run.pixels() * sizeof(glm::vec3), gpu::Memory::kDevice, "global light");
    ensureBytes(run.device, run.target.paths, run.pixels() * sizeof(shader::PixelPaths), gpu::Memory::kDevice, "pixels' paths");
    const std::uint32_t count = run.list.settled ? pathsMax(run.list) : kFirstPaths;
    const auto begin = Clock::now();
    for (std::uint32_t path = 0; path < count; ++path) addPath(run, pass, path, bands);
    run.target.light_spent.seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    run.target.path_count = count;
}

bool settlePixelPaths(PassRun& run, std::optional<Clock::time_point> until, BandSize& bands) {
    if (!run.list.plan->usesPathTracing()) return true;
    const std::uint32_t count = pathsMax(run.list);
    const auto begin = Clock::now();
    std::uint32_t& path = run.target.path_count;
    for (; path < count && !(until && Clock::now() >= *until); ++path) {
        for (const plan::PassPlan& pass : run.list.plan->passes) {
            if (pass.kind == plan::PassKind::kPixelPaths) addPath(run, pass, path, bands);
        }
    }
    run.target.light_spent.seconds += std::chrono::duration<double>(Clock::now() - begin).count();
    return path >= count;
}

void keepPathCount(gpu::Device& device, Target::Impl& target, const DrawList& list) {
    if (!list.plan->usesPathTracing() || target.path_count == 0) return;
    for (const shader::PixelPaths& paths : litPixels(device, target, list)) target.light_spent.samples += followed(paths);
    target.path_count = 0;
}

model::IlluminationInfo pathInfo(gpu::Device& device, const Target::Impl& target, const DrawList& list) {
    const std::vector<shader::PixelPaths> pixels = litPixels(device, target, list);
    model::IlluminationInfo info;
    info.texels = static_cast<std::uint64_t>(target.width) * static_cast<std::uint64_t>(target.height);
    info.texels_needed = pixels.size();
    info.samples = target.light_spent.samples;
    info.seconds = target.light_spent.seconds;
    info.bytes = target.paths.sizeBytes();
    const bool ended = target.path_count >= pathsMax(list);
    const auto drawn = static_cast<double>(std::max(target.samples, 1));
    std::vector<double> errors;
    for (const shader::PixelPaths& paths : pixels) {
        const bool exact =
            paths.relative_error < 0 || (target.path_count >= kLeastPaths && paths.relative_error <= wantedError(list));
        info.texels_done += ended || exact;
        info.texels_out_of_samples += ended && !exact;
        info.samples += followed(paths);
        if (paths.relative_error >= 0) errors.push_back(static_cast<double>(paths.relative_error) / std::sqrt(drawn));
    }
    if (errors.empty()) return info;
    for (const double error : errors) info.mean_error += error / static_cast<double>(errors.size());
    const auto at = errors.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(errors.size() - 1));
    std::ranges::nth_element(errors, at);
    info.p95_error = *at;
    return info;
}

void preparePaths(gpu::Device& device, PathLights& lights, store::Store& store, DrawList& list) {
    for (const plan::PassPlan& pass : list.plan->passes) {
        if (pass.kind != plan::PassKind::kPixelPaths) continue;
        const auto layer = static_cast<std::size_t>(pass.layer);
        const model::Scene& scene = list.plan->resolved.scene;
        const model::Illumination& wanted = *scene.light.illumination;
        const auto map = wanted.environment ? store.environment(wanted.environment->id) : nullptr;
        DrawnLayer& drawn = list.layers[layer];
        drawn.path_light = lights.get(device, drawn.volume, wanted, map, scene.layers[layer].surface().colour);
    }
}

}  // namespace radiata::render
