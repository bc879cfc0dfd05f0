// A shader as one pipeline needs it: its constants set, and gone what they leave no use for.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace lw {

using SpirV = std::span<const uint32_t>;

/// A value of a specialization constant.
struct SpecConstant {
    uint32_t id;
    uint32_t bits;  // of a bool, an integer or a float
};
using SpecConstants = std::span<const SpecConstant>;

/// `code` with specialization constants set, without the branches and functions that then never run. Constants that the
/// shader does not have are passed over. A driver that is given it instead of the whole text has less to translate: a
/// software rasterizer puts all functions into one before it looks at any constant. Throws Error for what is no SPIR-V.
std::vector<uint32_t> specialize(SpirV code, SpecConstants constants);

}  // namespace lw
