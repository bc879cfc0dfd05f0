// A shader as one pipeline needs it: its constants set, and gone what they leave no use for.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace lw {

using SpirV = std::span<const uint32_t>;
using Constants = std::span<const uint32_t>;

/// `code` with the specialization constant of constant_id i set to the bits of constants[i], without the branches and
/// functions that then never run. A driver that is given it instead of the whole text has less to translate: a software
/// rasterizer puts all functions into one before it looks at any constant. Throws Error for what is no SPIR-V.
std::vector<uint32_t> specialize(SpirV code, Constants constants);

}  // namespace lw
