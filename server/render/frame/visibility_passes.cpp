#include "render/frame/visibility_passes.h"

#include <cmath>
#include <numbers>
#include <string>

#include "gpu/device.h"
#include "render/frame/isosurface_passes.h"
#include "render/frame/sun_tiles.h"

namespace radiata::render {
namespace {

/// Numbers of the specialisation constants in shaders/glyph/visibility.comp and table.comp and in
/// shaders/common/light_visibility.glsl; lower ones are the passes' own.
constexpr std::size_t kFirstConstant = 20;

struct TablePush {
    std::uint64_t frame, layer;
};
struct VisibilityPush {
    std::uint64_t frame, layer, surface, counters, blocked;
    std::uint32_t first_block_row;
};

struct SurfaceVisibilityPush {
    std::uint64_t frame, layer, surface, blocked;
    std::uint32_t first_block_row;
};

enum Rays : std::uint32_t { kHardRays = 0, kSoftRays = 1, kAmbientRays = 2 };

/// Whether no earlier pass of the plan writes the same bits.
bool firstOfItsKind(const plan::FramePlan& plan, const plan::PassPlan& pass) {
    for (const plan::PassPlan& other : plan.passes) {
        if (other.kind == pass.kind) return &other == &pass;
    }
    return true;
}

/// Rays that an isosurface blocks.
void runSurfaceVisibility(PassRun& run, const plan::PassPlan& pass, BandSize& bands) {
    const plan::FramePlan& plan = *run.list.plan;
    const model::Light& light = plan.resolved.scene.light;
    const bool occlusion = pass.kind == plan::PassKind::kOcclusion;
    const bool hard = !occlusion && plan.visibility.shadow == model::Shadow::kHard;
    std::vector<std::uint32_t> constants = isosurfaceConstants(plan.resolved.quality.isosurface);
    constants.resize(kFirstConstant, 0U);
    constants.push_back(occlusion ? kAmbientRays : hard ? kHardRays : kSoftRays);
    constants.push_back(0U);
    constants.push_back(firstOfItsKind(plan, pass) ? 1U : 0U);
    constants.push_back(hard ? 1U : static_cast<std::uint32_t>(occlusion ? light.ambient_occlusion->rays : light.shadow_rays));
    const gpu::Buffer& bits = occlusion ? run.target.occlusion_bits : run.target.shadow_bits;
    run.dispatchBands(
        run.pipelines.get(pass.shader, constants), pass.name,
        SurfaceVisibilityPush{run.frameAddress(), isosurfaceAddress(run.target, static_cast<std::size_t>(pass.layer)),
                              run.target.surface.address(), bits.address(), 0},
        bands);
}

}  // namespace

void fillVisibilityParameters(gpu::Device& device, Target::Impl& target, const DrawList& list) {
    const model::Light& light = list.plan->resolved.scene.light;
    shader::FrameParams& frame = target.frame();
    const double radius = light.angular_radius_deg * std::numbers::pi / 180;
    frame.light_sine = static_cast<float>(std::sin(radius));
    frame.light_cosine = static_cast<float>(std::cos(radius));
    const std::uint64_t bytes = 4 * static_cast<std::uint64_t>(target.width) * static_cast<std::uint64_t>(target.height);
    for (const plan::PassPlan& pass : list.plan->passes) {
        const bool shadow = pass.kind == plan::PassKind::kShadow, occlusion = pass.kind == plan::PassKind::kOcclusion;
        const bool table = pass.kind == plan::PassKind::kSunTable;
        if (!shadow && !occlusion && !table) continue;
        const auto layer = static_cast<std::size_t>(pass.layer);
        if (shadow) ensureBytes(device, target.shadow_bits, bytes, gpu::Memory::kDevice, "shadow bits");
        if (occlusion) {
            ensureBytes(device, target.occlusion_bits, bytes, gpu::Memory::kDevice, "occlusion bits");
            frame.occlusion_radius = *light.ambient_occlusion->radius_mm;
        }
        if (!list.layers[layer].glyphs) continue;
        GlyphScene& scene = *list.layers[layer].glyphs;
        shader::GlyphLayerParams& params = target.layer(layer);
        if (table && params.count > 0) {
            const std::string& layout = list.plan->glyphs[layer].layout_name;
            const std::uint64_t entries = poleTableCount(std::stoi(layout.substr(4)), layout.starts_with("full"));
            gpu::Buffer& buffer = target.layers[layer].sun_table;
            ensureBytes(device, buffer, params.count * entries * 4, gpu::Memory::kDevice, "sun tables");
            params.sun_tables = buffer.address();
        }
        if (shadow && list.plan->visibility.sun_tiles) {
            const SunTiles tiles = sunTiles(list);
            frame.sun_right = tiles.right;
            frame.sun_up = tiles.up;
            frame.sun_tiles_x = static_cast<std::uint32_t>(tiles.x);
            frame.sun_tiles_y = static_cast<std::uint32_t>(tiles.y);
            listSunBoxes(device, target.layers[layer], params, scene, tiles);
        } else if (shadow || occlusion) {
            params.bvh_nodes = scene.bvhNodes().address();
            params.bvh_order = scene.bvhOrder().address();
        }
    }
}

void addVisibilityConstants(const plan::FramePlan& plan, std::vector<std::uint32_t>& constants) {
    const model::Light& light = plan.resolved.scene.light;
    const bool hard = plan.visibility.shadow == model::Shadow::kHard, soft = plan.visibility.shadow == model::Shadow::kSoft;
    if (!hard && !soft && !plan.visibility.occlusion) return;
    constants.resize(kFirstConstant, 0U);
    constants.push_back(soft ? 2U : hard ? 1U : 0U);
    constants.push_back(plan.visibility.occlusion ? 1U : 0U);
    constants.push_back(soft ? static_cast<std::uint32_t>(light.shadow_rays) : 1U);
    constants.push_back(plan.visibility.occlusion ? static_cast<std::uint32_t>(light.ambient_occlusion->rays) : 1U);
}

void runSunTable(PassRun& run, const plan::PassPlan& pass) {
    const auto layer = static_cast<std::size_t>(pass.layer);
    const std::uint32_t count = run.target.layer(layer).count;
    if (run.sample > 0 || count == 0) return;
    std::vector<std::uint32_t> constants(kFirstConstant, 0U);
    constants[0] = PassRun::kGroup;
    constants[4] = run.list.plan->glyphs[layer].used;
    constants.push_back(1U);  // towards the light
    run.recorder.dispatch(run.pipelines.get(pass.shader, constants), pass.name, PassRun::groups(count), 1, 1,
                          TablePush{run.frameAddress(), run.layerAddress(layer)});
}

void runVisibility(PassRun& run, const plan::PassPlan& pass, BandSize& bands) {
    const auto layer = static_cast<std::size_t>(pass.layer);
    const plan::FramePlan& plan = *run.list.plan;
    if (run.list.layers[layer].volume) return runSurfaceVisibility(run, pass, bands);
    const model::Light& light = plan.resolved.scene.light;
    const bool occlusion = pass.kind == plan::PassKind::kOcclusion;
    const bool hard = !occlusion && plan.visibility.shadow == model::Shadow::kHard;
    const bool empty = run.target.layer(layer).count == 0;
    std::vector<std::uint32_t> constants(kFirstConstant, 0U);
    constants[0] = PassRun::kGroup;
    constants[3] = plan.glyphs[layer].both_lobes ? 1U : 0U;
    constants[4] = plan.glyphs[layer].used;
    constants.push_back(occlusion ? kAmbientRays : hard ? kHardRays : kSoftRays);
    constants.push_back(hard && plan.visibility.sun_table && !empty ? 1U : 0U);
    constants.push_back(firstOfItsKind(plan, pass) ? 1U : 0U);
    constants.push_back(hard ? 1U : static_cast<std::uint32_t>(occlusion ? light.ambient_occlusion->rays : light.shadow_rays));
    constants.push_back(hard && plan.visibility.sun_tiles ? 1U : 0U);
    const gpu::Buffer& bits = occlusion ? run.target.occlusion_bits : run.target.shadow_bits;
    run.dispatchBands(run.pipelines.get(pass.shader, constants), pass.name,
                      VisibilityPush{run.frameAddress(), run.layerAddress(layer), run.target.surface.address(),
                                     run.counterAddress(), bits.address(), 0},
                      bands);
}

}  // namespace radiata::render
