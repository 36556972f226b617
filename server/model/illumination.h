// Light of a whole scene that isosurfaces are lit by globally, and how its transport is computed and kept.
// Source: Wyman et al. 2006. Directions and positions are world axes (RAS, mm); colours linear RGB.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace radiata::model {

/// Radiance a + g (d . up) from every direction d. Nowhere negative: each |gradient| is at most its radiance.
struct Sky {
    glm::vec3 radiance{0.8F};
    glm::vec3 gradient{0};
    glm::dvec3 up{0, 0, 1};  ///< any length but zero
    bool operator==(const Sky&) const = default;
};

/// A distant disc of even radiance.
struct SunDisc {
    glm::dvec3 direction{-0.4, 0.5, 0.8};  ///< towards it; any length but zero
    float angular_radius_deg = 5;          ///< above 0, to 90
    glm::vec3 irradiance{1};               ///< on a surface that faces it
    bool operator==(const SunDisc&) const = default;
};

/// A small light in the scene: a point, or a sphere of even radiance.
struct SphereLight {
    glm::dvec3 position_mm{0};
    float radius_mm = 0;     ///< 0: a point
    glm::vec3 intensity{1};  ///< irradiance times squared distance in mm^2, far from it
    bool operator==(const SphereLight&) const = default;
};

/// A picture of the sky, by the name it has in the catalogue, in place of Sky.
struct EnvironmentLight {
    std::string id;
    float scale = 1;
    bool operator==(const EnvironmentLight&) const = default;
};

/// Latitude and longitude: the middle looks along +y, columns go to +x, rows from +z down. Radiance, row by row.
struct EnvironmentMap {
    int width = 0, height = 0;
    std::vector<glm::vec3> pixels;
    std::string source;
    /// Red, green and blue in spherical harmonics of order 5, not turned, of scale 1; empty unless build/light_harmonics.h
    /// filled them in. Turning these costs nothing, summing up millions of pixels does.
    std::array<std::vector<double>, 3> harmonics{};
    std::uint32_t check = 0;  ///< of the pixels, where harmonics are
};

/// kLattice: texels beside the volume; kPathTracing: paths from each pixel's own point, kept by nobody.
enum class IlluminationMethod { kLattice, kPathTracing };
/// What a texel keeps, for each number of bounces: irradiance of this scene's light, or the transfer of any distant light.
enum class TexelPayload { kIrradiance, kTransfer };
/// kRgb8: irradiance alone, of this light and this colour of the surface, all bounces together, as in the paper's Table 2.
enum class TexelStorage { kFloat32, kFloat16, kRgb8 };
/// Which texels light a point (Wyman et al., Fig. 6): of the eight around it the one of nearest value; the nearest one; all
/// eight by distance; or 4 x 4 x 4 by a cubic B-spline.
enum class TexelInterpolation { kOwnIsovalue, kNearest, kTrilinear, kTricubic };
/// Points that a texel's paths are made of. Random ones are there for comparison.
enum class TexelSampling { kLowDiscrepancy, kRandom };
/// Texels per voxel: an eighth, one, or eight.
enum class LatticeResolution { kEighth, kOne, kEight };

constexpr int kBouncesMax = 4;

struct Illumination {
    IlluminationMethod method = IlluminationMethod::kLattice;
    TexelPayload payload = TexelPayload::kIrradiance;
    TexelStorage storage = TexelStorage::kFloat16;
    TexelInterpolation interpolation = TexelInterpolation::kTrilinear;
    TexelSampling sampling = TexelSampling::kLowDiscrepancy;
    LatticeResolution resolution = LatticeResolution::kOne;
    int bounces = 3;                                         ///< 0 to 4
    std::array<int, kBouncesMax + 1> orders{5, 3, 2, 2, 2};  ///< of kTransfer, by bounce; 1 to 5
    bool project = true;  ///< at rest texels are lit on the shown surface; false: on their own level sets, as in the paper
    /// All texels, on their own level sets, in place of those that a picture needs; saved beside the dataset once they are
    /// done.
    bool full = false;
    float relative_error = 0.02F;  ///< standard error at which a texel or pixel is done, of its value or a floor of 0.01
    int samples_max = 1024;        ///< per texel or pixel, a power of two from 4 to 16384
    float budget_mib = 1024;       ///< device memory for texels
    Sky sky;
    std::vector<SunDisc> suns;
    std::vector<SphereLight> lights;
    std::optional<EnvironmentLight> environment;
    std::array<double, 4> rotation{1, 0, 0,
                                   0};  ///< quaternion w, x, y, z that turns sky, suns and environment; any length but 0
    bool operator==(const Illumination&) const = default;

    /// Numbers that a texel keeps.
    int payloadCount() const {
        int count = 0;
        for (int k = 0; k <= bounces; ++k) count += orders[static_cast<std::size_t>(k)] * orders[static_cast<std::size_t>(k)];
        return payload == TexelPayload::kIrradiance ? 3 * (bounces + 1) : count;
    }
};

/// \throws Error(kInvalidArgument) with the field and what would be right \param where  prefix of the fields' names
void validate(const Illumination& light, const std::string& where);

/// How far a picture's global light is. Of path tracing, the picture's pixels take the place of texels.
struct IlluminationInfo {
    std::uint64_t texels = 0;                 ///< of the whole lattice
    std::uint64_t texels_needed = 0;          ///< by the pixels of the picture's latest sample
    std::uint64_t texels_done = 0;            ///< of them: at the wanted error, or at the largest number of samples
    std::uint64_t texels_out_of_samples = 0;  ///< of them: at the largest number of samples and not at the wanted error
    std::uint64_t bricks_left_out = 0;        ///< that the budget had no room for; what needs them is lit locally
    std::uint64_t samples = 0;                ///< paths followed for this picture, for all its samples together
    double mean_error = 0;                    ///< relative standard error of the texels needed that have light, mean
    double p95_error = 0;                     ///< and 95th percentile
    double seconds = 0;                       ///< spent on these paths
    std::uint64_t bytes = 0;                  ///< device memory of texels
    std::uint64_t payload_bytes = 0;          ///< of it: what the texels keep of light
    std::uint64_t texels_read = 0;            ///< of the whole lattice: that came from a saved one
    bool projected = false;                   ///< texels are lit on the shown surface
    std::string saved;                        ///< of Illumination::full, once it is done: the file's name, or why there is none
    bool operator==(const IlluminationInfo&) const = default;
};

}  // namespace radiata::model
