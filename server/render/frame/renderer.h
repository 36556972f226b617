// Runs the passes of a plan on the device and brings the picture back.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu/fwd.h"
#include "model/frame.h"
#include "model/limits.h"
#include "model/pick.h"

namespace radiata::store {
class Store;
}

namespace radiata::render {

/// Device buffers of one view: surface buffer, accumulated light, read-back. Each view owns one; only one render uses it at a
/// time.
class Target {
public:
    Target();
    ~Target();
    Target(Target&&) noexcept;
    Target& operator=(Target&&) noexcept;

    /// Leaves nothing of its view but memory that pictures of another take, up to kKeptPixels: a page of memory that a CPU
    /// driver takes anew costs as much as the light on its pixels.
    void forget();
    static constexpr int kKeptPixels = 1 << 21;

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// One thread renders; any thread may call what says so. Device and store must outlive it.
class Renderer {
public:
    /// Runs the start-up self-test: draws a known picture on each traversal path and drops a path whose picture is wrong.
    Renderer(gpu::Device& device, store::Store& store, const model::Limits& limits = {});
    ~Renderer();

    /// Adds samples [first_sample, first_sample + count) to the picture in the target and returns it.
    /// first_sample 0 starts anew; any other must continue the same request in the same target.
    /// The bytes depend on the request and on first_sample + count only, not on how the samples were split over calls.
    /// No samples of a picture of one: works for a slice of time at its global light, and returns it with info.samples 0 as
    /// long as that is not done; every call goes on, if the target is left alone. \param outputs  lossless arrays wanted too;
    /// taken from sample 0, so only with first_sample 0 \param cancel   looked at between submissions, at most every 50 ms; may
    /// be null \throws Error(kInvalidArgument, kNotFound, kResourceExhausted, kUnsupported), Error(kCancelled) if cancelled
    model::Frame render(Target& target, const model::FrameRequest& request, int first_sample, int count,
                        const model::Outputs& outputs = {}, const std::atomic<bool>* cancel = nullptr);

    /// All samples of the request at once.
    model::Frame renderAll(const model::FrameRequest& request, const model::Outputs& outputs = {},
                           const std::atomic<bool>* cancel = nullptr);

    /// A camera that shows the selection of a dataset as users expect: axial from the feet and coronal from the front in
    /// radiological convention (mirrored in neurological), sagittal from the left, orthographic.
    model::Camera fitCamera(const std::string& dataset_id, const model::VoxelSelection& selection, model::Convention convention,
                            double aspect);

    /// What the ray through a pixel's centre hits first, by the march, without its peaks. Draws that one pixel, so its cost
    /// does not depend on the picture's size. Direction and amplitude are in double from a hit that is exact to float: position
    /// within 1e-5 of the distance across the scene.
    /// Of fibres, which are thin, the one shown nearest to the pixel within the radius, of equally near ones the one nearest to
    /// the viewer; what else the pixel itself shows goes before fibres beside it. \throws as render(); Error(kInvalidArgument)
    /// for a pixel outside the picture, Error(kUnsupported) on a device where
    ///         tile lists are the only traversal that works
    /// \param all_hits  of the ray with the glyph that it meets first, by the request's method, too; see pick.proto's
    ///         PickedGlyph.hits. Error(kInvalidArgument) for methods without, and for ellipsoids
    std::optional<model::Picked> pick(const model::FrameRequest& request, int x, int y, int radius_px = 0,
                                      bool all_hits = false);

    /// The fibres of each layer that are seen in the pixels of an outline, or that are drawn through them, whatever hides them.
    /// \param outline  as for model::pixelsIn(). \throws as pick() and model::pixelsIn()
    std::vector<model::PickedFibres> pickFibres(const model::FrameRequest& request, std::span<const glm::dvec2> outline,
                                                bool through);

    /// Whether all that the request draws of fibres is on the device: tractograms, what is selected of them, what colours them.
    /// Any thread; answers at once, if the store has the tractograms. \throws as store::Store::fiblets()
    bool holdsFibres(const model::FrameRequest& request) const;
    /// Brings it there, which may take long; render() finds it, or else does so itself. Any thread. \throws as render()
    void bringFibres(const model::FrameRequest& request);

    /// GPU ms of the glyph passes' traversal alone over the finished picture in the target: it visits the boxes that the glyph
    /// pass visited up to each pixel's hit and intersects nothing. For measurements. \throws Error(kInternal) for another
    /// request
    double measureBoxes(Target& target, const model::FrameRequest& request);

    /// Names of the traversals that passed the self-test: "ray_query", "bvh", "tiles", "raster_boxes".
    std::vector<std::string> traversals() const;
    /// Tests all ways to draw fibres at once, as a server does if it is asked to; else each is tested before its first use.
    /// \return names of those that work: "atomic", "mesh-serial", ... \throws nothing for those that do not
    std::vector<std::string> testFibrePipelines();
    const std::string& deviceName() const;
    /// Pipelines made so far, those of the start-up self-test among them.
    std::size_t pipelineCount() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace radiata::render
