// Layers of tensor glyphs: which shader draws them by which method, with which settings.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/frame.h"

namespace radiata::plan {

/// tensor-march, tensor-interval or tensor-affine.
bool drawsTensors(model::Intersection method);
/// The method's name in scenes, on command lines and in sentences; empty for methods that draw spherical harmonics.
std::string_view tensorMethodName(model::Intersection method);

/// Whether this layer needs a shader of its own because of what it shows or how: ellipsoids, and tensors by tensor methods.
/// \param order  of the dataset's tensors; 0: it has none
/// \return  "tensor4", "ellipsoid", or nothing for layers that are drawn through their bands
/// \throws Error(kInvalidArgument) for a layer of tensor glyphs whose dataset has no tensors, ellipsoids of another order than
/// 2 or a
///         band limit below the order; (kUnsupported) for a tensor method on spherical harmonics or tensors of odd order
std::string tensorShader(const model::GlyphLayer& layer, const std::string& where, int order, model::Intersection method);

/// Specialisation constants 9 to 14 of shaders/glyph/intersect_tensor.glsl.
std::vector<std::uint32_t> tensorConstants(const model::Quality& quality);

}  // namespace radiata::plan
