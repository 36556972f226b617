// For each screen tile, which glyph boxes its rays may meet: primary rays then need no hierarchy.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "shaders/shared/frame.glsl"
#include "shaders/shared/glyph.glsl"

namespace radiata {

struct TileLists {
    int tiles_x = 0, tiles_y = 0;
    std::vector<glm::uvec2> ranges;      ///< per tile, row by row: first entry and number of entries
    std::vector<std::uint32_t> entries;  ///< indices of instances, in ascending order within a tile
    bool complete = true;                ///< false: more than the limit; the lists are empty and must not be used
};

/// Projects boxes to the picture, enlarged by the pixel that samples within it may be moved, and lists them per tile.
/// Boxes that reach behind the near plane of a perspective camera are listed in all tiles.
/// \param tile_shift_x, tile_shift_y  pixels per tile, log2
/// \param entries_max                 gives up beyond this many entries
TileLists buildTileLists(std::span<const shader::GlyphInstance> instances, const shader::CameraRays& rays, int width,
                         int height, int tile_shift_x, int tile_shift_y, std::size_t entries_max);

}  // namespace radiata
