#include "render/frame/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <list>
#include <utility>

#include "base/error.h"
#include "build/fibre_selection.h"
#include "build/glyph_instances.h"
#include "gpu/device.h"
#include "plan/fit_camera.h"
#include "render/frame/drawer.h"
#include "render/frame/fiblet_self_test.h"
#include "render/frame/fibre_scenes.h"
#include "render/frame/frame_lattices.h"
#include "render/frame/frame_notes.h"
#include "render/frame/illumination_passes.h"
#include "render/frame/outputs.h"
#include "render/frame/path_passes.h"
#include "render/frame/pick.h"
#include "render/frame/self_test.h"
#include "store/scalar_dataset.h"
#include "store/store.h"
#include "store/volume_dataset.h"

namespace radiata::render {
namespace {

constexpr std::size_t kScenesKept = 16;
/// A picture at rest shows its global light in between, when it works on it for so long.
constexpr std::chrono::milliseconds kSettleSlice{250};
/// Points decoded on the device may be that much outside of boxes made on the CPU.
constexpr double kDecodingMm = 1e-3;

/// Towards the light in world space. Unless it stands in the world it hangs on the camera, so pictures of any view are lit
/// alike.
glm::dvec3 lightDirection(const model::Light& light, const model::CameraFrame& axes) {
    if (light.direction_world) return glm::normalize(*light.direction_world);
    const glm::dvec3 d = glm::normalize(light.direction_camera);
    return glm::normalize(d.x * axes.right + d.y * axes.up - d.z * axes.forward);
}

plan::SceneBounds unite(const std::vector<DrawnLayer>& layers) {
    plan::SceneBounds all = layers.front().bounds;
    for (const DrawnLayer& layer : layers) {
        all.minimum = glm::min(all.minimum, layer.bounds.minimum);
        all.maximum = glm::max(all.maximum, layer.bounds.maximum);
    }
    return all;
}

/// World box of the points between the outermost samples, where a surface can be.
plan::SceneBounds volumeBounds(const store::VolumeDataset& volume) {
    plan::SceneBounds bounds{glm::dvec3(1e300), glm::dvec3(-1e300)};
    const glm::ivec3 last = volume.params().size - 1;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 grid(corner & 1 ? last.x : 0, corner & 2 ? last.y : 0, corner & 4 ? last.z : 0);
        const glm::dvec3 world = volume.gridToWorld(glm::dvec3(grid));
        bounds.minimum = glm::min(bounds.minimum, world);
        bounds.maximum = glm::max(bounds.maximum, world);
    }
    return bounds;
}

}  // namespace

struct Renderer::Impl {
    gpu::Device& device;
    store::Store& store;
    model::Limits limits;
    Drawer drawer;
    plan::Abilities abilities;
    std::optional<FibreSelfTest> fibre_test;
    std::string device_name;
    std::list<std::unique_ptr<GlyphScene>> scenes;  ///< most recently used first
    FrameLattices lattices;
    PathLights path_lights;
    FibreScenes tracts;
    Target own_target, pick_target;

    Impl(gpu::Device& the_device, store::Store& the_store, const model::Limits& the_limits)
        : device(the_device), store(the_store), limits(the_limits), drawer(the_device), tracts(the_limits.tract_memory_bytes) {
        abilities = selfTest(device, drawer);
        fibre_test.emplace(device, drawer, abilities);
        device_name = device.info().name + ", " + device.info().driver;
    }

    GlyphScene& scene(model::GlyphLayer layer, const glm::dvec3& centre, model::GlyphBoxes boxes) {
        layer.colour = {};  // colours change nothing about where glyphs are
        const auto dataset = store.glyphs(layer.dataset_id);
        const auto uncertainty = layer.uncertainty ? store.glyphs(layer.uncertainty->dataset_id) : nullptr;
        if (layer.uncertainty) {
            // How the medium looks changes nothing about where it is.
            const model::Uncertainty look;
            layer.uncertainty->extinction_per_mm = look.extinction_per_mm;
            layer.uncertainty->emission = look.emission;
        }
        for (auto it = scenes.begin(); it != scenes.end(); ++it) {
            GlyphScene& candidate = **it;
            if (candidate.layer() == layer && candidate.centreMm() == centre && &candidate.catalogued() == dataset.get() &&
                candidate.cataloguedUncertainty() == uncertainty.get() && candidate.boxes() == boxes) {
                scenes.splice(scenes.begin(), scenes, it);
                return candidate;
            }
        }
        scenes.push_front(std::make_unique<GlyphScene>(device, dataset, layer, centre, uncertainty, boxes));
        if (scenes.size() > kScenesKept) scenes.pop_back();
        return *scenes.front();
    }

    /// Of the dataset that a layer names, mm; all positions on the device are relative to that of the first layer.
    glm::dvec3 centreOf(const model::Layer& layer) {
        if (layer.ifTracts()) return tracts.scene(device, store.fiblets(layer.datasetId()))->bounds().centre();
        if (layer.ifGlyphs()) return datasetCentre(store.glyphs(layer.datasetId())->image());
        return volumeBounds(*store.volume(layer.datasetId())).centre();
    }

    /// The layer on the device, from scratch or from what is kept.
    DrawnLayer drawn(const model::Layer& layer, const model::Quality& quality, const glm::dvec3& centre) {
        DrawnLayer result;
        if (const model::GlyphLayer* glyphs = layer.ifGlyphs()) {
            // The band limit is checked by the plan; a scene of it can only be built within the data's bands.
            result.glyphs = &scene(*glyphs, centre, quality.glyph_boxes);
            result.bounds = result.glyphs->bounds();
            if (glyphs->colour.mode == model::ColourMode::kScalar) result.scalars = store.scalars(glyphs->colour.image_id);
        }
        if (const model::TractogramLayer* fibres = layer.ifTracts()) {
            result.tracts = tracts.scene(device, store.fiblets(fibres->dataset_id));
            result.fibres = tracts.look(device, result.tracts, *fibres, *store.selector(fibres->dataset_id));
            // Not where that is refused by the plan.
            const bool whole = !result.tracts->residency();
            if (whole && model::drawsUncompressed(quality.fiblet_pipeline))
                result.vertices = tracts.vertices(device, result.tracts);
            result.bounds = result.tracts->bounds();
            const double grown = kDecodingMm + static_cast<double>(fibres->tube_radius_mm.value_or(0));
            result.bounds.minimum -= grown;
            result.bounds.maximum += grown;
        }
        if (const model::IsosurfaceLayer* surface = layer.ifSurface()) {
            result.volume = store.volume(surface->dataset_id);
            result.bounds = volumeBounds(*result.volume);
            if (surface->colour_by) result.colours = store.volume(surface->colour_by->image_id);
            if (quality.isosurface.method == model::SurfaceMethod::kMarchingCubes && layer.opacity >= 1) {
                result.triangles = store.triangles(surface->dataset_id, surface->isovalue);
            }
        }
        return result;
    }

    /// What the plan has to know about a layer.
    plan::LayerFacts factsOf(const DrawnLayer& layer, const model::FrameRequest& request, const DrawList& list) const {
        if (layer.tracts) {
            plan::LayerFacts facts;
            facts.fibres = layer.fibres->shown();
            facts.fiblets = layer.tracts->fibletCount();
            facts.segments_filtered = layer.fibres->segmentAddress() != 0;
            facts.paged = layer.tracts->residency() != nullptr;
            facts.value_min = static_cast<double>(layer.fibres->colours->valueMin());
            facts.value_max = static_cast<double>(layer.fibres->colours->valueMax());
            return facts;
        }
        if (layer.volume) {
            plan::LayerFacts facts;
            facts.value_min = layer.volume->valueMin();
            facts.value_max = layer.volume->valueMax();
            facts.value_split = layer.volume->valueSplit();
            facts.voxel_edge_mm = layer.volume->params().voxel_mm;
            if (layer.colours) facts.colours = {layer.colours->valueMin(), layer.colours->valueMax()};
            return facts;
        }
        if (!layer.glyphs) return {};
        plan::LayerFacts facts = layer.glyphs->facts(list.camera, request.width, request.height);
        if (layer.scalars) {
            facts.value_min = layer.scalars->info().value_min;
            facts.value_max = layer.scalars->info().value_max;
        }
        if (request.scene.light.shadow == model::Shadow::kHard) {
            facts.sun_depth = layer.glyphs->depthAlong(list.light_direction_world);
        }
        return facts;
    }

    /// Everything that a picture needs, from scratch or from what is kept.
    DrawList prepare(const model::FrameRequest& request, plan::FramePlan& plan, model::FrameInfo& info) {
        const glm::dvec3 centre = centreOf(request.scene.layers[0]);
        DrawList list;
        for (const model::Layer& layer : request.scene.layers) {
            if (layer.ifTracts()) fibre_test->test(request.quality.fiblet_pipeline);
            list.layers.push_back(drawn(layer, request.quality, centre));
        }
        // Bounds united over layers, but relative positions to the one centre that all boxes have.
        plan::SceneBounds bounds = unite(list.layers);
        const glm::dvec3 reach = glm::max(glm::abs(bounds.minimum - centre), glm::abs(bounds.maximum - centre));
        bounds = {centre - reach, centre + reach};
        list.camera = plan::rebaseCamera(request.camera, bounds, request.height);
        if (request.quality.frozen_culling) {
            list.frozen = plan::rebaseCamera(*request.quality.frozen_culling, bounds, request.height);
        }
        list.light_direction_world = lightDirection(request.scene.light, model::cameraFrame(request.camera));
        std::vector<plan::LayerFacts> facts;
        for (const DrawnLayer& layer : list.layers) {
            facts.push_back(factsOf(layer, request, list));
            info.glyphs += facts.back().glyphs;
            info.glyphs_available += facts.back().glyphs_available;
        }
        plan = plan::planFrame(request, facts, abilities);
        list.plan = &plan;
        info.request = plan.resolved;
        info.pole_table_used = plan.uses_pole_table;
        info.pole_table_reason = plan.pole_table_reason;
        info.traversal_reason = plan.traversal_reason;
        info.sun_table_used = plan.visibility.sun_table;
        info.sun_table_reason = plan.visibility.sun_table_reason;
        info.depth_offset_mm = list.camera.depth_offset_mm;
        info.position_origin_mm = list.camera.reference_mm;
        info.device = device_name;
        return list;
    }
};

Renderer::Renderer(gpu::Device& device, store::Store& store, const model::Limits& limits)
    : impl_(std::make_unique<Impl>(device, store, limits)) {}
Renderer::~Renderer() = default;

model::Frame Renderer::render(Target& target, const model::FrameRequest& request, int first_sample, int count,
                              const model::Outputs& outputs, const std::atomic<bool>* cancel) {
    const auto begin = std::chrono::steady_clock::now();
    model::validate(request, impl_->limits);
    Target::Impl& buffers = *target.impl_;
    const int most = request.quality.samples == 1 ? 1 : impl_->limits.samples_max;
    const bool sliced = count == 0 && first_sample == 0 && request.quality.samples == 1;
    if ((count < 1 && !sliced) || first_sample < 0 || first_sample + count > most) {
        throw Error(Code::kInternal, "samples " + std::to_string(first_sample) + " to " + std::to_string(first_sample + count));
    }
    if (first_sample > 0 && (buffers.samples != first_sample || !(buffers.request == request))) {
        throw Error(Code::kInternal, "sample " + std::to_string(first_sample) + " does not continue the picture in the target");
    }
    model::Frame frame;
    plan::FramePlan plan;
    DrawList list = impl_->prepare(request, plan, frame.info);
    impl_->lattices.prepare(
        {impl_->device, impl_->drawer.recorder(), impl_->drawer.pipelines(), *impl_->own_target.impl_, list, 0, cancel}, list,
        impl_->store);
    preparePaths(impl_->device, impl_->path_lights, impl_->store, list);
    buffers.prepare(impl_->device, request.width, request.height, list.layers.size());
    list.picture_only = !outputs.any();
    const bool goes_on = std::exchange(buffers.in_slices, false) && sliced && buffers.request == request && !outputs.any();
    list.settled = first_sample == 0 && impl_->drawer.beginView(buffers, list, request);
    impl_->drawer.takeTimings();
    const bool global = plan.usesGlobalLight();
    // All samples at once are wanted as they will be; step by step, pictures show how far the light is.
    std::optional<std::chrono::steady_clock::time_point> until;
    if (sliced || first_sample + count < request.quality.samples || first_sample > 0) until = begin + kSettleSlice;
    const auto settle = [&] {
        list.settled = true;
        return !global || buffers.settled || impl_->drawer.settle(buffers, list, until, cancel);
    };
    const std::uint64_t read_before = pageBytesRead(list);
    // Moving pictures wait for no disk. Outputs are those of the finished picture.
    const bool moves = !sliced && first_sample == 0 && count < request.quality.samples && !outputs.any();
    if (moves) list.pages_until = begin;
    list.moving = plan.usesPeels() && !sliced && first_sample == 0 && count < request.quality.samples;
    const bool kept = goes_on && !buffers.pages_missing && buffers.pages_serial == pagesSerial(list);
    const int end = sliced && !kept ? 1 : first_sample + count;
    for (int sample = first_sample; sample < end; ++sample) {
        list.moving = list.moving && sample == 0;
        // Other views may have taken the place of pages that the light of this one is still to fall on.
        const bool pages_lost = global && !buffers.settled && buffers.pages_serial != pagesSerial(list);
        if (sample > 0 && (buffers.pages_missing || pages_lost)) {
            list.pages_until = until;
            impl_->drawer.drawSample(buffers, list, 0, cancel);
            buffers.hit_pixels = buffers.counters().hit_pixels;
            if (buffers.pages_missing) break;
        }
        list.pages_until = sample == 0 ? list.pages_until : std::nullopt;
        if (sample > 0 && !settle()) break;
        // A picture that rests has its first sample drawn as the others are.
        if (sample > 0 && buffers.approximate) impl_->drawer.drawSample(buffers, list, 0, cancel);
        impl_->drawer.drawSample(buffers, list, sample, cancel);
        notePasses(impl_->drawer.takeTimings(), frame.info.passes);
        if (sample == 0) {
            list.settled = buffers.settled;
            buffers.request_surface = buffers.surface_number;
            buffers.hit_pixels = buffers.counters().hit_pixels;
            if (outputs.any()) readOutputs(impl_->device, impl_->drawer, buffers, list, outputs, frame.pixels);
        }
    }
    if (buffers.samples == request.quality.samples) buffers.in_slices = !settle() && sliced;
    if (global) impl_->lattices.save(list, impl_->store);
    if (global) {
        frame.info.illumination = plan.usesPathTracing() ? pathInfo(impl_->device, buffers, list) : illuminationInfo(list);
    }
    frame.info.hit_pixels = buffers.hit_pixels;
    frame.info.capped_rays = buffers.counters().capped_rays;
    noteLeftOut(list, frame.info);
    noteFiblets(buffers, list, frame.info);
    frame.info.fiblet_bytes_read = pageBytesRead(list) - read_before;
    noteFibreMemory(list, impl_->store);
    impl_->drawer.resolve(buffers, list);
    frame.pixels.width = request.width;
    frame.pixels.height = request.height;
    const std::size_t bytes = static_cast<std::size_t>(request.width) * static_cast<std::size_t>(request.height) * 4;
    const auto picture = buffers.picture.as<std::uint8_t>().first(bytes);
    frame.pixels.rgba.assign(picture.begin(), picture.end());
    frame.info.samples = buffers.in_slices ? 0 : buffers.samples;
    frame.info.state = frame.info.samples >= request.quality.samples ? model::FrameState::kConverged
                       : first_sample == 0                           ? model::FrameState::kInteractive
                                                                     : model::FrameState::kRefining;
    notePasses(impl_->drawer.takeTimings(), frame.info.passes);
    frame.info.render_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    return frame;
}

model::Frame Renderer::renderAll(const model::FrameRequest& request, const model::Outputs& outputs,
                                 const std::atomic<bool>* cancel) {
    return render(impl_->own_target, request, 0, request.quality.samples, outputs, cancel);
}

std::optional<model::Picked> Renderer::pick(const model::FrameRequest& request, int x, int y, int radius_px, bool all_hits) {
    model::validate(request, impl_->limits);
    if (all_hits) model::checkAllHits(request);
    model::FrameRequest pixel = pickRequest(request, x, y, radius_px, impl_->abilities);
    const auto pickIn = [&] {
        model::FrameInfo info;
        plan::FramePlan plan;
        DrawList list = impl_->prepare(pixel, plan, info);
        FoundGlyph found_glyph;
        if (all_hits) found_glyph = allHitsFinder(impl_->device, impl_->drawer, list, request.quality, impl_->abilities);
        return pickPixel(impl_->device, impl_->drawer, *impl_->pick_target.impl_, list, x, y, radius_px, found_glyph);
    };
    std::optional<model::Picked> picked = pickIn();
    if (!picked && makeSurfacesOpaque(pixel)) picked = pickIn();
    return picked;
}

std::vector<model::PickedFibres> Renderer::pickFibres(const model::FrameRequest& request, std::span<const glm::dvec2> outline,
                                                      bool through) {
    model::validate(request, impl_->limits);
    const model::OutlinePixels pixels = model::pixelsIn(outline, {request.width, request.height});
    const model::FrameRequest pixel = pickRequest(request, 0, 0, 0, impl_->abilities);
    model::FrameInfo info;
    plan::FramePlan plan;
    DrawList list = impl_->prepare(pixel, plan, info);
    return pickOutline(impl_->device, impl_->drawer, *impl_->pick_target.impl_, list, pixels, through);
}

double Renderer::measureBoxes(Target& target, const model::FrameRequest& request) {
    Target::Impl& buffers = *target.impl_;
    if (buffers.samples == 0 || !(buffers.request == request)) {
        throw Error(Code::kInternal, "measureBoxes: the target does not hold this request's picture");
    }
    model::FrameInfo info;
    plan::FramePlan plan;
    const DrawList list = impl_->prepare(request, plan, info);
    impl_->drawer.takeTimings();
    impl_->drawer.drawBoxes(buffers, list);
    double total = 0;
    for (const gpu::PassTiming& timing : impl_->drawer.takeTimings()) total += timing.time_ms;
    return total;
}

std::vector<std::string> Renderer::traversals() const {
    std::vector<std::string> names;
    if (impl_->abilities.ray_query) names.emplace_back("ray_query");
    if (impl_->abilities.bvh) names.emplace_back("bvh");
    if (impl_->abilities.tiles) names.emplace_back("tiles");
    if (impl_->abilities.raster) names.emplace_back("raster_boxes");
    return names;
}

bool Renderer::holdsFibres(const model::FrameRequest& request) const { return impl_->tracts.hold(impl_->store, request); }

void Renderer::bringFibres(const model::FrameRequest& request) { impl_->tracts.bring(impl_->device, impl_->store, request); }

std::vector<std::string> Renderer::testFibrePipelines() { return impl_->fibre_test->testAll(); }

const std::string& Renderer::deviceName() const { return impl_->device_name; }

std::size_t Renderer::pipelineCount() const { return impl_->drawer.pipelines().count(); }

model::Camera Renderer::fitCamera(const std::string& dataset_id, const model::VoxelSelection& selection,
                                  model::Convention convention, double aspect) {
    if (!(aspect >= 0.05 && aspect <= 20)) {
        throw Error(Code::kInvalidArgument, "aspect is " + std::to_string(aspect) + "; it must be 0.05 to 20");
    }
    if (impl_->store.info(dataset_id).kind == model::DatasetKind::kTractogram) {
        const model::DatasetInfo info = impl_->store.info(dataset_id);
        return plan::fitCamera({info.bounds_min, info.bounds_max}, selection, convention, aspect);
    }
    if (impl_->store.info(dataset_id).kind == model::DatasetKind::kScalarVolume) {
        return plan::fitCamera(volumeBounds(*impl_->store.volume(dataset_id)), selection, convention, aspect);
    }
    const auto dataset = impl_->store.glyphs(dataset_id);
    const plan::SceneBounds bounds = selectionBounds(*dataset, selection);
    return plan::fitCamera(bounds, selection, convention, aspect);
}

}  // namespace radiata::render
