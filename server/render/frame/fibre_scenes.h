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
    /// \throws as FibletScene()
    std::shared_ptr<const FibletScene> scene(gpu::Device& device, const std::shared_ptr<const model::FibletSet>& set);
    /// \throws as FibreLook()
    std::shared_ptr<const FibreLook> look(gpu::Device& device, const std::shared_ptr<const FibletScene>& scene,
                                          const model::TractogramLayer& layer);
    /// \throws as FibreVertices()
    std::shared_ptr<const FibreVertices> vertices(gpu::Device& device, const std::shared_ptr<const FibletScene>& scene);

private:
    static constexpr std::size_t kScenesKept = 8, kLooksKept = 16;
    struct KeptLook {
        std::uint64_t scene_serial;
        model::TractogramLayer layer;  ///< what of it does not change the look is left at its default
        std::shared_ptr<const FibreLook> look;
    };
    std::list<std::shared_ptr<const FibletScene>> scenes_;  ///< most recently used first
    std::list<KeptLook> looks_;
    /// Of one tractogram: they are large.
    std::uint64_t vertices_serial_ = 0;
    std::shared_ptr<const FibreVertices> vertices_;
};

}  // namespace radiata::render
