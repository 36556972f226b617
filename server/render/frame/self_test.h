// The start-up self-test: a known picture on each traversal path.
#pragma once

#include "plan/plan.h"
#include "render/frame/drawer.h"

namespace radiata::render {

/// Draws spheres of several sizes on a grid, whose hits have a closed form, by each path the device offers, and compares each
/// pixel's depth and glyph with it. \return the abilities, without the paths whose picture is wrong or whose drawing failed
plan::Abilities selfTest(gpu::Device& device, Drawer& drawer);

}  // namespace radiata::render
