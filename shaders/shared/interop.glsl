// Lets GLSL and C++ read the same struct definitions. Scalar block layout on both sides; on the C++ side the structs live in
// namespace radiata::shader and STATIC_SIZE checks that no compiler padded them.
#ifndef RADIATA_SHARED_INTEROP
#define RADIATA_SHARED_INTEROP

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
namespace radiata::shader {
using uint = std::uint32_t;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using ivec3 = glm::ivec3;
}  // namespace radiata::shader
#define STATIC_SIZE(Type, bytes) static_assert(sizeof(Type) == bytes, #Type " differs between C++ and GLSL")
#define SHADER_NAMESPACE_BEGIN namespace radiata::shader {
#define SHADER_NAMESPACE_END }
#else
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#define STATIC_SIZE(Type, bytes)
#define SHADER_NAMESPACE_BEGIN
#define SHADER_NAMESPACE_END
#endif

#endif
