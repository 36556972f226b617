// Lists of glyph boxes along the light's direction, by tiles of a plane across it: what tile lists are for the camera's rays,
// for rays towards a distant light.
#pragma once

#include "render/frame/pass_run.h"

namespace radiata::render {

/// A grid through the frame's reference point that covers all glyphs of the scene.
struct SunTiles {
    shader::CameraRays rays{};  ///< orthographic, along the light; its pixels are a quarter of a tile
    glm::vec3 right{0}, up{0};  ///< tiles per mm
    int x = 1, y = 1;           ///< tiles
};

/// Tiles about half as large as the boxes, and at most a million.
SunTiles sunTiles(const DrawList& list);

/// Fills the layer's lists and notes their addresses. \throws Error(kResourceExhausted)
void listSunBoxes(gpu::Device& device, LayerBuffers& buffers, shader::GlyphLayerParams& params, const GlyphScene& scene,
                  const SunTiles& tiles);

}  // namespace radiata::render
