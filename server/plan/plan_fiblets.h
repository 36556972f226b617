// How a layer of fibres is drawn.
#pragma once

#include <cstdint>

#include "model/frame.h"

namespace radiata::plan {

struct FramePlan;
struct LayerFacts;
struct Abilities;

struct FibletPlan {
    model::FibletPipeline pipeline = model::FibletPipeline::kAtomic;
    bool mesh_subgroups = false;  ///< of pipeline mesh
    model::FibletCulling culling = model::FibletCulling::kTwoPhase;
    bool lines = true;           ///< some fibres are lines
    bool tubes = false;          ///< some are tubes
    bool selected_only = false;  ///< of the tubes: those of selected fibres
    bool states = false;         ///< fibres are hidden or selected one by one
    bool dimmed = false;         ///< those that are not selected
    bool segments = false;       ///< single segments are left out
    bool exact_width = false;    ///< lines have their width across
    bool paged = false;          ///< not all fiblets are on the device
    bool mesh_cut = false;       ///< what is shown lies between the faces of a mesh, or does not:
    bool mesh_outside = false;
    std::uint32_t cuts = 0;
    int line_width_px = 1;
    float tube_radius_mm = 0;
    float detail_px = 0;  ///< that lines may be off; 0: they are drawn as they are
};

/// Adds a layer's pass and its entry in plan.fiblets, and fills in its open choices.
/// \throws Error(kUnsupported) for a pipeline that the device lacks, saying what it lacks
void planFiblets(std::size_t index, const LayerFacts& facts, const Abilities& abilities, FramePlan& plan);

/// Fills in which culling is meant where the request leaves it open: one for the frame, two phases if they pay for any layer,
/// so that the request as it is resolved plans to the same passes again. What is asked for by name is done. After
/// planFiblets().
void resolveCulling(const std::vector<LayerFacts>& layers, FramePlan& plan);

}  // namespace radiata::plan
