// Builds the pole-frame table of one glyph for an array of cameras. Shared values: the glyph's coefficients.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/test/function.glsl"
#include "shaders/test/camera_io.glsl"
#include "sh_basis.glsl"
#include "circle.glsl"
#include "pole_table.glsl"
#include "shaders/common/camera_rays.glsl"

struct PoleTable {
    vec3 pole;
    float table[POLE_TABLE_COUNT];
};

FUNCTION_OVER(PoleInput, PoleTable)

PoleTable function(PoleInput x) {
    float c[SH_COUNT];
    for (int i = 0; i < SH_COUNT; ++i) c[i] = push.shared_values.value[i];
    PoleTable result;
    result.pole = poleAxis(x.rays, x.centre);
    poleTableBuild(c, result.pole, result.table);
    return result;
}

FUNCTION_MAIN
