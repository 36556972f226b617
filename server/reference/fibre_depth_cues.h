// Depth cues of fibres in a picture of depths. Twin of shaders/common/fibre_depth_cues.glsl and shaders/frame/fibre_depth.glsl.
#pragma once

#include <span>

namespace radiata::reference {

/// Whether a nearer fibre's halo hides a pixel (Everts et al. 2009): some pixel within `width_px` of it is nearer by so much
/// that the distance lies within the share (ahead - gap) / (4 gap) of the width, the gap being twice the width. \param depth of
/// all pixels, row by row, mm; infinity: nothing \param size_mm  of a pixel
bool inHalo(std::span<const float> depth, int width, int height, int x, int y, double width_px, double size_mm);

/// Share of light that a neighbour leaves, of depths alone (Eichelbaum et al. 2013): the mean over the whole disc, which the
/// device samples. \param radius_px  of the disc
double openness(std::span<const float> depth, int width, int height, int x, int y, double radius_px, double size_mm);

}  // namespace radiata::reference
