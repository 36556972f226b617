// Frame of the shaders that run one function over an array of inputs for the tests in tests/gpu/functions. A wrapper is:
//   #include "shaders/test/function.glsl"
//   FUNCTION_OVER(Input, Output)     // two structs or scalars, scalar layout
//   Output function(Input x) { ... } // may read shared_values.value[]
//   FUNCTION_MAIN
// The C++ side is tests/gpu/functions/function_runner.h. Specialisation constants of the wrapper start at id 1.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "shaders/common/invocation.glsl"

layout(buffer_reference, scalar) readonly buffer SharedValues { float value[]; };

#define FUNCTION_OVER(Input, Output)                                          \
    layout(buffer_reference, scalar) readonly buffer Inputs { Input value[]; }; \
    layout(buffer_reference, scalar) writeonly buffer Outputs { Output value[]; }; \
    layout(push_constant, scalar) uniform Push {                              \
        Inputs inputs;                                                        \
        Outputs outputs;                                                      \
        SharedValues shared_values;                                           \
        uint count;                                                           \
    } push;

#define FUNCTION_MAIN                                                                        \
    void main() {                                                                            \
        const uint i = globalInvocation();                                              \
        if (i < push.count) push.outputs.value[i] = function(push.inputs.value[i]);          \
    }
