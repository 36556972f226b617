// Tractograms on the device and what layers make of their fibres, kept while they are in use and a little longer.
#pragma once

#include <list>
#include <memory>

#include "render/fiblet/fiblet_scene.h"
#include "render/fiblet/fibre_look.h"
#include "render/fiblet/fibre_vertices.h"

namespace radiata::render {

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

private:
    static constexpr std::size_t kScenesKept = 8, kLooksKept = 16;
    template <typename Part>
    struct Kept {
        std::uint64_t scene_serial;
        model::TractogramLayer layer;  ///< what of it does not change the part is left at its default
        std::shared_ptr<const Part> part;
    };
    /// The part that is kept for these settings, or a new one.
    template <typename Part, typename Make>
    static std::shared_ptr<const Part> find(std::list<Kept<Part>>& kept, const FibletScene& scene,
                                            const model::TractogramLayer& layer, Make&& make);
    std::uint64_t budget_bytes_;
    std::list<std::shared_ptr<const FibletScene>> scenes_;  ///< most recently used first
    std::list<Kept<FibreFilter>> filters_;
    std::list<Kept<FibreColours>> colours_;
    /// Of one tractogram: they are large.
    std::uint64_t vertices_serial_ = 0;
    std::shared_ptr<const FibreVertices> vertices_;
};

}  // namespace radiata::render
