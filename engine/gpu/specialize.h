// Specializes a shader for one pipeline: sets its constants and removes the code that they make unreachable.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace lw {

using SpirV = std::span<const uint32_t>;

/// A value of a specialization constant.
struct SpecConstant {
    uint32_t id;
    uint32_t bits;  // the value, a bool, an integer or a float, as 32 bits
};
using SpecConstants = std::span<const SpecConstant>;

/// Returns `code` with its specialization constants set to `constants`, without the branches and functions that then
/// never run. Constants that the shader does not have are ignored. A driver compiles the result faster: a software
/// rasterizer inlines all functions before it looks at any constant. Throws Error when `code` is not SPIR-V.
std::vector<uint32_t> specialize(SpirV code, SpecConstants constants);

}  // namespace lw
