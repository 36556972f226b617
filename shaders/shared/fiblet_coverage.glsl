// What the coverage buffer of Schertzer et al. 2022 (Sec. 3.4) is made of. Texels are squares of FIBLET_TEXEL pixels, rows first.
#ifndef RADIATA_SHARED_FIBLET_COVERAGE
#define RADIATA_SHARED_FIBLET_COVERAGE
#include "shaders/shared/fiblet_draw.glsl"
SHADER_NAMESPACE_BEGIN

#ifdef __cplusplus
constexpr uint FIBLET_TEXEL_LEVEL = 4;
constexpr uint FIBLET_TEXEL = 16;
#else
#define FIBLET_TEXEL_LEVEL 4
#define FIBLET_TEXEL 16
#endif

struct FibletCoverageParams {
    FibletView before;  // of the picture whose depths are dilated
    FibletView now;     // that fiblets are culled for
    uint64_t depths;    // uint[texels]: farthest order of depths under each texel of a picture, a level of its pyramid
    uint64_t dilated;   // uint[texels]: order of the depth behind which no fiblet of the picture before can be seen
    uint64_t moved;     // uint[texels]: the same for the view that is culled for; 0: not known
    int columns;
    int rows;
    float reach;        // mm: length of the longest fiblet
    float far_depth;    // depth of texels that show nothing, for `before`
};
STATIC_SIZE(FibletCoverageParams, 264);

SHADER_NAMESPACE_END
#endif
