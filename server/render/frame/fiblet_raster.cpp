#include "render/frame/fiblet_raster.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "render/frame/fibre_light.h"

namespace radiata::render {
namespace {

constexpr std::size_t kChainConstant = 17;  ///< of raster.comp

struct BeginPush {
    std::uint64_t layer, surface, veil;
};
struct RasterPush {
    std::uint64_t layer, list;
    std::uint32_t first, count;
};
struct SurfacePush {
    std::uint64_t layer, surface, counters;
};
struct SheetPush {
    std::uint64_t layer, surface;
    std::uint32_t slot, padding = 0;
};

}  // namespace

void FibletRaster::begin(bool empty) {
    if (empty) {
        run_.recorder.fill(own_.words, 0, 8 * run_.pixels(), 0xffffffffU);
        return;
    }
    run_.recorder.dispatch(
        run_.pipelines.get("fiblet_begin", {PassRun::kGroup, use.counting ? 1U : 0U, use.chain, use.peeling ? 1U : 0U}),
        "fiblet begin" + layer_.suffix, PassRun::groups(run_.pixels()), 1, 1,
        BeginPush{own_.layerAddress(), run_.target.surface.address(), use.peeling ? run_.target.veil.address() : 0});
}

void FibletRaster::draw(bool listed, std::uint32_t first, std::uint32_t end) {
    const bool nearest = use.chain == 0 && !use.finding;
    const bool parallel = own_.layer().view.inverse_distance == 0;
    std::vector<std::uint32_t> constants = layer_.withPaged(
        {PassRun::kGroup, parallel ? 1U : 0U, plan_.cuts, plan_.tubes ? 1U : 0U, plan_.lines && drawsLines() ? 1U : 0U,
         plan_.states ? 1U : 0U, plan_.selected_only ? 1U : 0U, plan_.segments ? 1U : 0U, plan_.exact_width ? 1U : 0U,
         use.peeling ? 1U : 0U, use.counting ? 1U : 0U, use.finding ? 1U : 0U, nearest ? own_.layer().detail_segments : 0U,
         nearest && layer_.byCoverage() ? 1U : 0U, plan_.mesh_cut ? 1U : 0U, plan_.mesh_outside ? 1U : 0U});
    if (use.chain != 0) {
        constants.resize(kChainConstant, 0U);
        constants.push_back(use.chain);
    }
    const gpu::ComputePipeline& pipeline = run_.pipelines.get("fiblet_raster", constants);
    while (first < end) {
        run_.checkCancelled();
        const auto wanted = static_cast<std::uint32_t>(std::min(layer_.pace.fiblets, 4e6));
        const std::uint32_t count = std::min(end - first, wanted / PassRun::kGroup * PassRun::kGroup);
        run_.recorder.dispatch(pipeline, "fiblet raster" + layer_.suffix, PassRun::groups(count), 1, 1,
                               RasterPush{own_.layerAddress(), listed ? own_.list.address() : 0, first, count});
        layer_.submit(count);
        first += count;
    }
}

std::uint32_t FibletRaster::resolve(const Resolve& how) {
    if (!how.marks_only && lightsFibres(run_)) {
        lightFibres(layer_, how.marks, how.counts);
    } else {
        toSurface(how);
    }
    return takeRepaired();
}

std::uint32_t FibletRaster::resolveSheet(std::uint32_t slot) {
    const bool alone = layer_.first;
    run_.recorder.dispatch(
        run_.pipelines.get("fiblet_sheet", layer_.withPaged({PassRun::kGroup, alone ? 1U : 0U, use.chain, slot == 0 ? 1U : 0U,
                                                             plan_.tubes ? 1U : 0U, plan_.selected_only ? 1U : 0U, 0U})),
        "fiblet sheet" + layer_.suffix, PassRun::groups(run_.pixels()), 1, 1,
        SheetPush{own_.layerAddress(), run_.target.peel_surface.address(), alone ? slot : 0});
    return slot == 0 ? takeRepaired() : 0;
}

std::uint32_t FibletRaster::takeRepaired() {
    layer_.submit(0);
    return std::min(std::exchange(own_.counts().repaired, 0), own_.layer().list_size);
}

void FibletRaster::toSurface(const Resolve& how) {
    run_.recorder.dispatch(
        run_.pipelines.get("fiblet_surface",
                           layer_.withPaged({PassRun::kGroup, layer_.first ? 1U : 0U, how.marks ? 1U : 0U,
                                             plan_.tubes ? 1U : 0U, plan_.selected_only ? 1U : 0U, how.marks_only ? 1U : 0U})),
        "fiblet surface" + layer_.suffix, PassRun::groups(run_.pixels()), 1, 1,
        SurfacePush{own_.layerAddress(), run_.target.surface.address(), how.counts ? run_.counterAddress() : 0});
}

}  // namespace radiata::render
