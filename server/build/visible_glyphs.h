// The glyphs that a camera can see, in the order in which they are drawn as triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "build/box_projection.h"

namespace radiata {

struct VisibleGlyphs {
    std::vector<std::uint32_t> order;  ///< instances, nearest centre first, the lower of equally near ones first
    std::vector<PixelRect> pixels;     ///< that the box of each may touch
};

/// Leaves out glyphs whose boxes are out of the picture or of the depth range.
VisibleGlyphs visibleGlyphs(std::span<const shader::GlyphInstance> instances, const shader::CameraRays& rays, int width,
                            int height);

/// A part of the work of drawing: glyphs [first, first + count) of the order in rows [first_row, first_row + rows).
struct DrawPart {
    std::uint32_t first = 0, count = 0;
    std::uint32_t first_row = 0, rows = 0;
    double work = 0;
};

/// The part that comes at (next, row), about as large as `work_wanted` in units of pixels but never less than one row of one
/// glyph. Whole glyphs are taken together; one that is more than enough alone is cut into bands of rows.
/// \param work_per_glyph  what a glyph costs apart from its pixels, in pixels \param count_max  glyphs in one part
DrawPart nextPart(const VisibleGlyphs& glyphs, std::uint32_t next, std::uint32_t row, double work_wanted, double work_per_glyph,
                  std::uint32_t count_max, int height);

}  // namespace radiata
