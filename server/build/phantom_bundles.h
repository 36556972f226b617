// The fibre bundles of the test brain: named, with fixed ids, as centre lines in world mm (RAS) with a radius along them.
// Geometry only: what a scanner would see of it (phantom_field.h) and streamlines along it start from here.
// The courses are drawn after the anatomy of the named tracts in MNI-like coordinates (origin at the anterior commissure);
// they are no atlas. In each centrum semiovale (x about -30 and 30, y -18, z 32) three of them cross at right angles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace radiata::phantom {

enum BundleId : int {
    kNoBundle = 0,
    kCorpusCallosum = 1,
    kCorticospinalLeft = 2,
    kCorticospinalRight = 3,
    kArcuateLeft = 4,
    kArcuateRight = 5,
    kCingulumLeft = 6,
    kCingulumRight = 7,
};

/// A centre line: a Catmull-Rom spline, sampled about every millimetre.
struct Strand {
    std::vector<glm::dvec3> points;    ///< world mm
    std::vector<glm::dvec3> tangents;  ///< unit, towards the next point
    std::vector<double> radii;         ///< mm, where the fibres end sideways
};

/// Fibres that belong together; strands of a bundle that overlap share one direction.
struct Bundle {
    int id = kNoBundle;
    std::string name;
    double fraction = 1;  ///< of a voxel's volume in the bundle's core
    std::vector<Strand> strands;
};

/// All bundles by increasing id, 1 to 7. The seed shifts the control points by up to 1 mm, left and right as mirror images.
std::vector<Bundle> bundles(std::uint64_t seed);

}  // namespace radiata::phantom
