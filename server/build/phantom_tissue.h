// What a point of the test brain is made of, apart from the bundles: the shape of the head's inside.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace radiata::phantom {

/// Extent of the head's inside in world mm, with a margin; images cover it.
constexpr double kHeadMin[3] = {-72, -108, -72};
constexpr double kHeadMax[3] = {72, 74, 82};

enum class Tissue { kOutside, kFluid, kGrey, kWhite };

struct TissueSample {
    Tissue tissue = Tissue::kOutside;
    double cortex = 0;      ///< 0 below the cortex, rising smoothly to 1 in it
    glm::dvec3 outward{0};  ///< unit, away from the middle of the nearest part (hemisphere, cerebellum, brainstem)
};

/// Ellipsoids for hemispheres, cerebellum, brainstem and ventricles; the cortex is folded by waves, a fissure parts the
/// hemispheres. Left and right are mirror images but for the phase of the waves.
TissueSample tissueAt(const glm::dvec3& p_world, std::uint64_t seed);

}  // namespace radiata::phantom
