// Runs cubic.glsl over an array of chords: the first root, -1 where there is none.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/isosurface_io.glsl"
#include "shaders/common/cubic.glsl"

FUNCTION_OVER(CubicInput, float)

float function(CubicInput x) {
    float c[8];
    for (int i = 0; i < 8; ++i) c[i] = x.corners[i] - x.isovalue;
    const float from = cellValue(c, x.from), to = cellValue(c, x.to);
    return firstCubicRoot(cellCubic(c, x.from, x.to, from, to), to);
}

FUNCTION_MAIN
