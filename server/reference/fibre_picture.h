// Which segment of a tractogram each pixel shows, by intersecting planes in space. Twin of shaders/fiblet/raster.comp.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "model/camera.h"

namespace radiata::reference {

struct FibreSegment {
    glm::dvec3 from{0}, to{0};  ///< world, mm
    std::uint32_t who = 0;
};

struct FibrePixel {
    static constexpr std::uint32_t kNobody = 0xffffffffU;
    std::uint32_t who = kNobody;
    double depth_mm = std::numeric_limits<double>::infinity();  ///< from the eye along the line of sight
    bool sure = true;  ///< false: shifts of 2e-3 pixels or 1e-3 mm may change who is seen
};

/// A segment is seen in a pixel if it passes the plane through the eye and the centres of the pixel's column (or row, if it is
/// longer in that direction) where the pixel is, ends half open; the nearest wins, then the lower `who`.
/// \param line_width  pixels across, whole and odd
/// \return row-major, first row on top
std::vector<FibrePixel> fibrePicture(std::span<const FibreSegment> segments, const model::Camera& camera, int width, int height,
                                     int line_width = 1);

}  // namespace radiata::reference
