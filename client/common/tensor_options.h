// Options for layers of tensor glyphs and the methods that draw tensors.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "radiata/v1/quality.pb.h"
#include "radiata/v1/scene.pb.h"

namespace radiata::client {

struct TensorOptions {
    std::optional<v1::TensorShape> shape;  ///< absent: a layer of glyphs, which shows tensor images through their bands
    v1::TensorMarch march;
};

void addTensorOptions(CLI::App& app, TensorOptions& options);

/// The message in the layer that holds selection, scale and so on, made if the layer has none of the wanted kind.
v1::GlyphLayer& glyphsOf(v1::Layer& layer, const TensorOptions& options);
/// The same of a layer that is made already.
v1::GlyphLayer& glyphsOf(v1::Layer& layer);

}  // namespace radiata::client
