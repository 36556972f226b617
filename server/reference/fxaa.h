// Twin of shaders/frame/fxaa.comp.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace radiata::reference {

/// One pixel of a smoothed picture, 0 to 1 a channel. Between pixels each counts by its distance along columns and rows.
/// \param rgba  row-major, 4 bytes a pixel
glm::dvec3 fxaaPixel(const std::vector<std::uint8_t>& rgba, int width, int height, int x, int y);

}  // namespace radiata::reference
