// Runs the passes of a layer of fiblets: words begin as what earlier layers show, fiblets are culled and drawn into them, and
// what they won goes to the surface buffer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "render/frame/fiblet_lines.h"

namespace radiata::render {

/// All passes of the layer, in bounded submissions.
void runFiblets(PassRun& run, const plan::PassPlan& pass, FibletPace& pace);

/// A transparent layer of fibres while it is peeled: who finds, round by round, the nearest segments behind those that were
/// composed (shaders/frame/peel.glsl).
class FibletPeel {
public:
    /// \param counted  the first round counts the segments before what is opaque
    FibletPeel(PassRun& run, std::size_t layer, FibletPace& pace, bool counted);
    ~FibletPeel();
    FibletPeel(FibletPeel&&) noexcept;

    /// Puts segments into the target's peel surface where they are the nearest so far. \param first  nothing is composed yet
    void find(bool first);
    /// Of shader::FibletLayerParams.
    std::uint64_t address() const;

private:
    std::unique_ptr<class FibletRun> run_;
    bool counted_;
};

/// Sets the bits of fibres that are drawn through pixels, whatever hides them. \param inside  address of one bit per pixel of
/// the target, 32 to a word \param found  address of one bit per fibre
void runFibletsThrough(PassRun& run, const plan::PassPlan& pass, std::uint64_t inside, std::uint64_t found);

}  // namespace radiata::render
