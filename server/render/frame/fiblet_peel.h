// Fibres that do not hide each other: a transparent layer, segment by segment, and what lies in an outline on the picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "render/frame/fiblet_run.h"

namespace radiata::render {

/// A transparent layer of fibres while it is peeled: who finds, round by round, the nearest segments behind those that were
/// composed (shaders/frame/peel.glsl).
class FibletPeel {
public:
    /// \param alone    no other layer is transparent: the peel surface is what this one finds
    /// \param slots    rounds for which fibres are drawn at once
    /// \param counted  the first round counts the segments before what is opaque
    FibletPeel(PassRun& run, std::size_t layer, FibletPace& pace, bool alone, std::uint32_t slots, bool counted);
    ~FibletPeel();
    FibletPeel(FibletPeel&&) noexcept;

    /// Puts segments into the target's peel surface where they are the nearest so far. \param round  counted from 0
    void find(std::uint32_t round);
    /// Of shader::FibletLayerParams.
    std::uint64_t address() const;

private:
    struct Layer;
    std::unique_ptr<Layer> layer_;
    std::uint32_t slots_;
    bool counted_;
};

/// Sets the bits of fibres that are drawn through pixels, whatever hides them. \param inside  address of one bit per pixel of
/// the target, 32 to a word \param found  address of one bit per fibre
void runFibletsThrough(PassRun& run, const plan::PassPlan& pass, std::uint64_t inside, std::uint64_t found);

}  // namespace radiata::render
