// One layer of fiblets as its passes read it.
#extension GL_EXT_shader_atomic_int64 : require
#include "shaders/shared/fiblet_draw.glsl"
#include "shaders/common/fiblet_projection.glsl"
#include "shaders/common/depth_order.glsl"

layout(local_size_x_id = 0) in;

layout(buffer_reference, scalar) readonly buffer LayerBuffer { FibletLayerParams layer; };
layout(buffer_reference, scalar) readonly buffer PageBuffer { FibletPage at[]; };
layout(buffer_reference, scalar) readonly buffer HeadBuffer { FibletHead at[]; };
layout(buffer_reference, scalar) readonly buffer BoxBuffer { FibletBox at[]; };
layout(buffer_reference, scalar) buffer WordBuffer { uint64_t at[]; };
layout(buffer_reference, scalar) buffer UintBuffer { uint at[]; };
layout(buffer_reference, scalar) buffer CountsBuffer { FibletCounts counts; };

uint fibreState(FibletLayerParams layer, uint fibre) {
    if (layer.states == 0ul) return FIBRE_SHOWN;
    return UintBuffer(layer.states).at[fibre >> 2u] >> (8u * (fibre & 3u)) & 0xffu;
}
