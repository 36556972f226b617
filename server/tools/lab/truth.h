// What a pixel's ray hits first, in double, over all glyphs of a scene.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include "model/frame.h"
#include "reference/camera_rays.h"
#include "reference/sh_function.h"
#include "store/store.h"

namespace radiata::lab {

struct TrueHit {
    bool decided = true;  ///< the answer does not hang on the last digits of the ray
    bool hit = false;
    double depth_mm = std::numeric_limits<double>::infinity();  ///< along the line of sight, from the eye's plane
    double radius_mm = 0;                                       ///< of the glyph that is hit
    glm::dvec3 normal{0};                                       ///< towards the viewer
};

/// Thread-safe after construction.
class Truth {
public:
    Truth(store::Store& store, const model::FrameRequest& request);

    TrueHit at(int x, int y) const;
    double largestRadiusMm() const { return largest_radius_; }

private:
    struct Glyph {
        reference::ShFunction f;
        glm::dvec3 centre;
        double scale = 0;   ///< mm per amplitude
        double radius = 0;  ///< mm, certified
        bool both_lobes = false;
    };
    void consider(const Glyph& glyph, const reference::Ray& ray, double along, double stretch, TrueHit& best) const;

    model::FrameRequest request_;
    glm::dvec3 forward_;
    std::vector<Glyph> glyphs_;
    double largest_radius_ = 0;
};

}  // namespace radiata::lab
