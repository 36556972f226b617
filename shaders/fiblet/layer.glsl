// One layer of fiblets as its passes of compute, task and mesh shaders read it.
#extension GL_EXT_shader_atomic_int64 : require
#include "shaders/fiblet/layer_buffers.glsl"

layout(local_size_x_id = 0) in;
