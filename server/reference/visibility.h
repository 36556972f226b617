// What stands between a point and a light, by testing every glyph with the exhaustive hits of glyph_hits. Twin of the shaders'
// shadow and ambient rays.
#pragma once

#include <limits>
#include <span>

#include <glm/glm.hpp>

#include "reference/sh_function.h"

namespace radiata::reference {

/// One glyph where it stands: the surface |p - centre| = scale |f|.
struct PlacedGlyph {
    const ShFunction* f = nullptr;
    glm::dvec3 centre_mm{0};
    double scale = 1;  ///< mm per unit of amplitude
};

struct Visibility {
    bool blocked = false;
    bool sure =
        true;  ///< false: moving the ray by 1e-5 radii of some glyph changes its hits, or one is within 1e-4 of the start
};

/// Whether a ray from a point outside of all glyphs, or on the surface of one, meets any of them.
/// \param own     the glyph on whose surface the origin lies, or -1; its hits within 1e-4 radii of the origin do not count
/// \param t_max   length of the ray, mm
Visibility visibilityOf(std::span<const PlacedGlyph> glyphs, const glm::dvec3& origin_mm, const glm::dvec3& direction,
                        bool both_lobes, int own = -1, double t_max = std::numeric_limits<double>::infinity());

}  // namespace radiata::reference
