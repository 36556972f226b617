#include "render/frame/frame_notes.h"

#include <algorithm>
#include <bit>

#include "render/frame/fiblet_buffers.h"
#include "store/store.h"

namespace radiata::render {

void notePasses(const std::vector<gpu::PassTiming>& timings, std::vector<model::PassTime>& passes) {
    for (const gpu::PassTiming& timing : timings) {
        const auto same = std::ranges::find(passes, timing.name, &model::PassTime::name);
        if (same == passes.end()) {
            passes.push_back({timing.name, timing.shader, timing.time_ms});
        } else {
            same->time_ms = timing.time_ms;
        }
    }
}

void noteLeftOut(const Target::Impl& target, const DrawList& list, model::FrameInfo& info) {
    const model::Scene& scene = list.plan->resolved.scene;
    const auto first_surface =
        std::ranges::find_if(scene.layers, [](const model::Layer& layer) { return layer.ifSurface() != nullptr; });
    const auto unlit = static_cast<std::size_t>(first_surface == scene.layers.end() ? 0 : first_surface - scene.layers.begin());
    for (std::size_t i = 0; i < list.layers.size(); ++i) {
        model::LeftOut left_out;
        if (list.layers[i].glyphs != nullptr) left_out = list.layers[i].glyphs->leftOut();
        if (list.layers[i].tracts) {
            left_out.fiblet_pages = target.fiblets[i]->pages_wanted;
            left_out.fiblet_pages_left_out = target.fiblets[i]->pages_left_out + target.fiblets[i]->pages_missing;
        }
        left_out.global_light = i == unlit && scene.light.illumination && !list.plan->usesGlobalLight();
        left_out.layer = static_cast<int>(i);
        if (left_out.anything()) info.left_out.push_back(left_out);
    }
}

void noteFiblets(const Target::Impl& target, const DrawList& list, model::FrameInfo& info) {
    for (std::size_t i = 0; i < list.layers.size(); ++i) {
        if (!list.layers[i].tracts) continue;
        const FibletBuffers& own = *target.fiblets[i];
        info.fiblets += list.layers[i].tracts->fibletCount();
        info.fiblets_drawn += own.drawn;
        info.fiblet_pages_wanted += own.pages_wanted;
        info.fiblet_pages_resident += own.pages_wanted - own.pages_left_out - own.pages_missing;
        info.fiblet_pages_left_out += own.pages_left_out;
        info.fiblet_error_px = std::max(info.fiblet_error_px, static_cast<double>(std::bit_cast<float>(own.counts().error_px)));
    }
}

std::uint64_t pageBytesRead(const DrawList& list) {
    std::uint64_t bytes = 0;
    for (const DrawnLayer& layer : list.layers) {
        if (layer.tracts && layer.tracts->residency()) bytes += layer.tracts->residency()->bytesRead();
    }
    return bytes;
}

void noteFibreMemory(const DrawList& list, store::Store& store) {
    for (std::size_t i = 0; i < list.layers.size(); ++i) {
        const FibletScene* scene = list.layers[i].tracts.get();
        if (!scene) continue;
        store.setFibreMemory(list.plan->resolved.scene.layers[i].datasetId(),
                             {scene->deviceBytes(), scene->pages().size(), scene->residentPages()});
    }
}

}  // namespace radiata::render
