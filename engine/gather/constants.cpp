#include "gather/constants.h"

#include <bit>

namespace lw {
namespace {

uint32_t bits_of(bool value) { return value; }
uint32_t bits_of(uint value) { return value; }
uint32_t bits_of(float value) { return std::bit_cast<uint32_t>(value); }

}  // namespace

#define LW_CONSTANT(type, name, value) {__LINE__, bits_of(constants.name)},

std::vector<SpecConstant> listed(const FrameConstants& constants) {
    return {
#include "shaders/frame_constants.h"
    };
}

std::vector<SpecConstant> listed(const ViewConstants& constants) {
    return {
#include "shaders/view_constants.h"
    };
}

}  // namespace lw
