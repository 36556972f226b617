// The self-test of the ways to draw fibres: a known picture by each.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "model/tractogram_layer.h"
#include "plan/plan.h"
#include "render/frame/drawer.h"

namespace radiata::render {

/// Each way is tested once: by testAll() if a server is to, or else before its first use. Plans refuse those that failed
/// (plan::Abilities::failed_pipelines). A way is drawn a lattice of fibres that zigzag towards the viewer and back, whose
/// picture is known pixel by pixel, fibre, point and depth; one that cannot be run fails too.
class FibreSelfTest {
public:
    using Pipeline = model::FibletPipeline;

    /// Adds what the device says that it can do for fibres to the abilities. All must outlive the object.
    FibreSelfTest(gpu::Device& device, Drawer& drawer, plan::Abilities& abilities);

    /// \param wanted  kAuto: atomic, and pull if that fails
    void test(Pipeline wanted);
    /// \return names of those that work
    std::vector<std::string> testAll();

private:
    static std::uint32_t bit(Pipeline one) { return 1U << static_cast<unsigned>(one); }
    bool failed(Pipeline one) const { return (abilities_.failed_pipelines & bit(one)) != 0; }
    bool works(Pipeline pipeline);

    gpu::Device& device_;
    Drawer& drawer_;
    plan::Abilities& abilities_;
    std::shared_ptr<const FibletScene> scene_;  ///< the lattice
    std::uint32_t tested_ = 0;
};

}  // namespace radiata::render
