// What one layer of fiblets has in buffers.
#include "shaders/shared/fiblet_draw.glsl"
#include "shaders/common/fiblet_projection.glsl"
#include "shaders/common/depth_order.glsl"
#include "shaders/common/fiblet_heads.glsl"

layout(buffer_reference, scalar) readonly buffer LayerBuffer { FibletLayerParams layer; };
layout(buffer_reference, scalar) readonly buffer PageBuffer { FibletPage at[]; };
layout(buffer_reference, scalar) readonly buffer BoxBuffer { FibletBox at[]; };
layout(buffer_reference, scalar) buffer WordBuffer { uint64_t at[]; };
layout(buffer_reference, scalar) buffer UintBuffer { uint at[]; };
layout(buffer_reference, scalar) buffer CountsBuffer { FibletCounts counts; };

uint fibreState(FibletLayerParams layer, uint fibre) {
    if (layer.states == 0ul) return FIBRE_SHOWN;
    return UintBuffer(layer.states).at[fibre >> 2u] >> (8u * (fibre & 3u)) & 0xffu;
}
