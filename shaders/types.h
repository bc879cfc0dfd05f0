// The aliases that let one text compile as C++ and as GLSL. Scalar block layout on both sides.
#ifndef LW_TYPES_H
#define LW_TYPES_H
#ifdef __cplusplus
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/integer.hpp>
namespace lw {
using glm::abs, glm::clamp, glm::cross, glm::dot, glm::floor, glm::fract, glm::length, glm::max, glm::min, glm::mix;
using glm::acos, glm::atan, glm::cos, glm::exp, glm::log, glm::normalize, glm::pow, glm::sin, glm::sqrt;
using glm::bitCount, glm::findLSB, glm::floatBitsToUint, glm::uintBitsToFloat;
using glm::ivec2, glm::uvec2, glm::uvec3, glm::uvec4, glm::vec2, glm::vec3, glm::vec4, glm::mat3;
using uint = uint32_t;
}  // namespace lw
#define LW_CONST constexpr
#define LW_INLINE inline
#define LW_MEMBER const
#define LW_INOUT(T) T&
#else
#define LW_CONST const
#define LW_INLINE
#define LW_MEMBER
#define LW_INOUT(T) inout T
// A row of frame_constants.h or view_constants.h.
#define LW_CONSTANT(type, name, value) layout(constant_id = __LINE__) const type name = value;
#endif
#ifdef __cplusplus
namespace lw {
#endif

LW_CONST float lw_pi = 3.14159265358979f;

#ifdef __cplusplus
}  // namespace lw
#endif
#endif
