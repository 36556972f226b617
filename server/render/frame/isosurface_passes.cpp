#include "render/frame/isosurface_passes.h"

#include "gpu/device.h"
#include "plan/plan_isosurface.h"
#include "render/frame/surface_looks.h"
#include "store/volume_dataset.h"

namespace radiata::render {
namespace {

/// Of transparent surfaces along one ray.
constexpr std::uint32_t kCrossingsMax = 16;

struct ClearPush {
    std::uint64_t surface;
    std::uint32_t pixels, padding = 0;
};
struct TracePush {
    std::uint64_t frame, layer, surface, counters;
    std::uint32_t first_block_row;
};
struct VeilPush {
    std::uint64_t frame, layers, surface, looks, veil, surface_looks;
    std::uint32_t transparent, first_block_row;
};
struct PeelPush {
    std::uint64_t frame, layers, opaque, found, looks, peel;
    std::uint32_t transparent, first_block_row;
};

}  // namespace

void placeInGrid(const store::VolumeDataset& volume, const glm::dvec3& reference_mm, glm::ivec3& base, glm::vec3& fraction) {
    const glm::dvec3 grid = volume.worldToGrid(reference_mm);
    // A reference point far off would not fit whole numbers that floats hold exactly; the rest then carries it.
    const glm::dvec3 whole = glm::clamp(glm::floor(grid), glm::dvec3(0), glm::dvec3(volume.params().size));
    base = glm::ivec3(whole);
    fraction = glm::vec3(grid - whole);
}

std::uint64_t isosurfaceAddress(const Target::Impl& target, std::size_t layer) {
    return target.isosurfaces.address() + layer * sizeof(shader::IsosurfaceParams);
}

std::vector<std::uint32_t> isosurfaceConstants(const model::IsosurfaceSettings& settings) {
    return {PassRun::kGroup, settings.bricks ? 1U : 0U, settings.method == model::SurfaceMethod::kMarchBisect ? 1U : 0U,
            settings.normals == model::SurfaceNormals::kSpline ? 1U : 0U, static_cast<std::uint32_t>(settings.bisections)};
}

void fillIsosurfaceParameters(gpu::Device& device, Target::Impl& target, const DrawList& list) {
    const model::FrameRequest& request = list.plan->resolved;
    for (std::size_t i = 0; i < list.layers.size(); ++i) {
        const store::VolumeDataset* volume = list.layers[i].volume.get();
        if (!volume) continue;
        ensureBytes(device, target.isosurfaces, 8 * sizeof(shader::IsosurfaceParams), gpu::Memory::kUpload,
                    "isosurface parameters");
        shader::IsosurfaceParams params{};
        params.volume = volume->params();
        placeInGrid(*volume, list.camera.reference_mm, params.base, params.fraction);
        params.isovalue = *request.scene.layers[i].surface().isovalue;
        params.layer = static_cast<std::uint32_t>(i);
        params.step = request.quality.isosurface.step;
        target.isosurfaces.as<shader::IsosurfaceParams>()[i] = params;
    }
    if (!list.plan->usesVeil()) return;
    const std::uint64_t pixels = static_cast<std::uint64_t>(target.width) * static_cast<std::uint64_t>(target.height);
    ensureBytes(device, target.veil, pixels * sizeof(glm::vec4), gpu::Memory::kDevice, "veil");
}

void runClear(PassRun& run, const plan::PassPlan& pass) {
    run.recorder.dispatch(run.pipelines.get(pass.shader, {PassRun::kGroup}), pass.name, PassRun::groups(run.pixels()), 1, 1,
                          ClearPush{run.target.surface.address(), static_cast<std::uint32_t>(run.pixels())});
}

void runIsosurfaceTrace(PassRun& run, const plan::PassPlan& pass, BandSize& bands) {
    std::vector<std::uint32_t> constants = isosurfaceConstants(run.list.plan->resolved.quality.isosurface);
    constants.push_back(pass.first ? 1U : 0U);
    run.dispatchBands(run.pipelines.get(pass.shader, constants), pass.name,
                      TracePush{run.frameAddress(), isosurfaceAddress(run.target, static_cast<std::size_t>(pass.layer)),
                                run.target.surface.address(), run.counterAddress(), 0},
                      bands);
}

void runIsosurfaceVeil(PassRun& run, const plan::PassPlan& pass, BandSize& bands) {
    std::uint32_t transparent = 0;
    const std::vector<model::Layer>& layers = run.list.plan->resolved.scene.layers;
    for (std::size_t i = 0; i < layers.size(); ++i) transparent |= plan::isVeil(layers[i]) ? 1U << i : 0U;
    std::vector<std::uint32_t> constants = isosurfaceConstants(run.list.plan->resolved.quality.isosurface);
    constants.resize(10);
    constants[5] = kCrossingsMax;
    constants.push_back(run.list.plan->surface_looks);
    run.dispatchBands(run.pipelines.get(pass.shader, constants), pass.name,
                      VeilPush{run.frameAddress(), run.target.isosurfaces.address(), run.target.surface.address(),
                               run.frameAddress() + Target::Impl::kLookOffset, run.target.veil.address(),
                               surfaceLooksAddress(run.target, *run.list.plan), transparent, 0},
                      bands);
}

void runIsosurfacePeel(PassRun& run, std::uint32_t surfaces, std::uint64_t peel, bool counting, BandSize& bands) {
    std::vector<std::uint32_t> constants = isosurfaceConstants(run.list.plan->resolved.quality.isosurface);
    constants.push_back(kCrossingsMax);
    constants.push_back(counting ? 1U : 0U);
    run.dispatchBands(
        run.pipelines.get("isosurface_peel", constants), "isosurface peel",
        PeelPush{run.frameAddress(), run.target.isosurfaces.address(), run.target.surface.address(),
                 run.target.peel_surface.address(), run.frameAddress() + Target::Impl::kLookOffset, peel, surfaces, 0},
        bands);
}

}  // namespace radiata::render
