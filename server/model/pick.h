// What lies under a pixel: a point on a glyph, its function and its peaks; or a point on an isosurface.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "math/sh_layout.h"

namespace radiata::model {

struct Peak {
    glm::dvec3 direction{0};  ///< unit, world axes; for even layouts one of the two ends
    double amplitude = 0;     ///< above 0
    bool operator==(const Peak&) const = default;
};

/// Where the ray of a pick crosses the glyph's surface.
struct RayHit {
    double distance_mm = 0;     ///< along the ray from the eye, or from the plane through an orthographic camera's eye
    glm::dvec3 position_mm{0};  ///< on the ray, world
    glm::dvec3 direction{0};    ///< from centre to position, unit
    double radius_mm = 0;
    bool negative_lobe = false;
    bool leaving = false;  ///< else the ray enters
};

struct PickedGlyph {
    int layer = 0;
    std::string dataset_id;
    glm::ivec3 voxel{0};
    glm::dvec3 centre_mm{0};    ///< of the voxel, world
    glm::dvec3 position_mm{0};  ///< on the surface, world
    glm::dvec3 direction{0};    ///< from centre to position, unit
    double radius_mm = 0;
    double amplitude = 0;  ///< of the function in that direction, signed

    /// The function that is drawn: its bands, internal convention.
    ShLayout layout;
    std::vector<float> coefficients;

    int peak_rank = 0;          ///< from 1: the peak that the surface rises to; 0: none
    double peak_angle_deg = 0;  ///< from the direction to that peak
    std::vector<Peak> peaks;    ///< the largest first; of even layouts the end nearer to the direction

    std::vector<RayHit> hits;  ///< if asked for: all of the ray with this glyph, the nearest first
};

struct FibreValue {
    std::string column;
    std::vector<float> numbers;  ///< of the fibre
    bool operator==(const FibreValue&) const = default;
};

struct PickedFibre {
    int layer = 0;
    std::string dataset_id;
    std::uint32_t fibre = 0;
    std::uint32_t point = 0;          ///< before the place, from 0
    glm::dvec3 position_mm{0};        ///< world, on the fibre
    glm::dvec3 tangent{0};            ///< unit, world
    double length_mm = 0;             ///< of the fibre
    double distance_px = 0;           ///< from the pixel that was asked for
    std::vector<std::string> groups;  ///< that the fibre is in
    std::vector<FibreValue> values;
};

struct PickedSurface {
    int layer = 0;
    std::string dataset_id;
    glm::ivec3 voxel{0};        ///< nearest to the position
    glm::dvec3 position_mm{0};  ///< on the surface, world
    glm::dvec3 normal{0};       ///< unit, world axes, towards the viewer
    double value = 0;           ///< of the trilinear volume there
};

/// Fibres of one layer within an outline.
struct PickedFibres {
    int layer = 0;
    std::string dataset_id;
    std::vector<std::uint32_t> fibres;  ///< ascending
};

using Picked = std::variant<PickedGlyph, PickedFibre, PickedSurface>;
/// How far from the pixel fibres are looked for.
constexpr int kPickRadiusMax = 64;

struct FrameRequest;
/// \throws Error(kInvalidArgument) if the picture's method finds no more than the first hit of a ray
void checkAllHits(const FrameRequest& request);

}  // namespace radiata::model
