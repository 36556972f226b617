// Tractograms on the device and what layers make of their fibres, kept while they are in use and a little longer. Decoding all
// fibres for a region, and uploading them, may take seconds; so both may be done beside the render thread, which then finds
// what is kept.
#pragma once

#include <list>
#include <memory>
#include <mutex>

#include "model/frame.h"
#include "render/fiblet/fiblet_scene.h"
#include "render/fiblet/fibre_look.h"
#include "render/fiblet/fibre_vertices.h"

namespace radiata::store {
class Store;
}

namespace radiata::render {

/// Thread-safe but for vertices(), which is the render thread's. Whoever finds nothing kept makes it, and holds up nobody else.
class FibreScenes {
public:
    /// \param budget_bytes  of each tractogram; 0: whatever it takes
    explicit FibreScenes(std::uint64_t budget_bytes = 0) : budget_bytes_(budget_bytes) {}
    /// \throws as FibletScene()
    std::shared_ptr<const FibletScene> scene(gpu::Device& device, const std::shared_ptr<const model::FibletSet>& set);
    /// \param selector  of the same tractogram. \throws as FibreFilter() and FibreColours()
    FibreLook look(gpu::Device& device, const std::shared_ptr<const FibletScene>& scene, const model::TractogramLayer& layer,
                   FibreSelector& selector);
    /// \throws as FibreVertices()
    std::shared_ptr<const FibreVertices> vertices(gpu::Device& device, const std::shared_ptr<const FibletScene>& scene);

    /// Whether scene() and look() find all that a picture of the request draws of fibres. Answers at once.
    /// \throws as store::Store::fiblets()
    bool hold(store::Store& store, const model::FrameRequest& request) const;
    /// Makes what they do not. \throws as they do
    void bring(gpu::Device& device, store::Store& store, const model::FrameRequest& request);

private:
    /// As many as a request may have layers, at least: what was brought for it is there when it is drawn.
    static constexpr std::size_t kScenesKept = 8, kLooksKept = 16;
    template <typename Part>
    struct Kept {
        std::uint64_t scene_serial;
        model::TractogramLayer layer;  ///< what of it does not change the part is left at its default
        std::shared_ptr<const Part> part;
    };
    using Scenes = std::list<std::shared_ptr<const FibletScene>>;
    /// With the lock held.
    static Scenes::const_iterator find(const Scenes& scenes, const model::FibletSet& set);
    template <typename Part>
    static typename std::list<Kept<Part>>::const_iterator find(const std::list<Kept<Part>>& kept, const FibletScene& scene,
                                                               const model::TractogramLayer& layer);
    /// The part that is kept for these settings, or a new one.
    template <typename Part, typename Make>
    std::shared_ptr<const Part> keep(std::list<Kept<Part>>& kept, const FibletScene& scene, const model::TractogramLayer& layer,
                                     Make&& make);
    std::uint64_t budget_bytes_;
    mutable std::mutex mutex_;  ///< of the lists, never held while anything is made
    Scenes scenes_;             ///< most recently used first
    std::list<Kept<FibreFilter>> filters_;
    std::list<Kept<FibreColours>> colours_;
    /// Of one tractogram: they are large.
    std::uint64_t vertices_serial_ = 0;
    std::shared_ptr<const FibreVertices> vertices_;
};

}  // namespace radiata::render
