// The ways to find hits, by the names that scene and command line know them by, each with the settings worth measuring.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "math/sh_layout.h"
#include "model/frame.h"

namespace radiata::lab {

struct Method {
    std::string name;    ///< with its setting: "polynomial, paper's stop"
    std::string family;  ///< method alone; one colour in plots
    std::function<void(model::Quality&)> set;
};

/// Equal steps along the ray, as before Peters et al. \param per_ray  coefficients rotated for each ray, not once for the
/// camera
Method rayMarch(model::Intersection intersection, int steps, bool per_ray);
/// All that can draw glyphs of this layout, the march first.
std::vector<Method> glyphMethods(ShLayout layout);
/// Those whose name begins so, in the order of `names`. \throws Error(kInternal) for a name that no method has
std::vector<Method> glyphMethods(ShLayout layout, const std::vector<std::string>& names);

}  // namespace radiata::lab
