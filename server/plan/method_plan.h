// Which modules draw a layer by the intersection method that is asked for, and what they are compiled with.
#pragma once

#include <string>

#include "plan/plan.h"

namespace radiata::plan {

/// Fills layout_name, used, method_module and method_constants.
/// \param where  the layer, for messages
/// \throws Error(kInvalidArgument) for a band limit above the data, Error(kUnsupported) for a method that does not fit the data
///         or needs what the device lacks, with what would do
GlyphPlan planMethod(const model::Quality& quality, const model::GlyphLayer& layer, const LayerFacts& facts,
                     const Abilities& abilities, const std::string& where);

/// Whether the method can use a table per glyph for rays that share the camera.
bool hasTable(model::Intersection method);
/// Module that builds it, and floats per glyph that it takes.
std::string tableModule(model::Intersection method, const GlyphPlan& glyphs);
std::uint32_t tableFloats(model::Intersection method, const GlyphPlan& glyphs);

}  // namespace radiata::plan
