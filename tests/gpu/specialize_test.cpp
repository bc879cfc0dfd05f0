#include "gpu/specialize.h"

#include <gtest/gtest.h>

#include <bit>
#include <spirv-tools/libspirv.hpp>

#include "base/error.h"

namespace lw {
namespace {

/// Stores `scale` times one of two functions, chosen by `is_chosen`.
constexpr const char* shader = R"(
               OpCapability Shader
               OpMemoryModel Logical GLSL450
               OpEntryPoint GLCompute %main "main" %out
               OpExecutionMode %main LocalSize 1 1 1
               OpName %chosen "chosen"
               OpName %other "other"
               OpDecorate %is_chosen SpecId 0
               OpDecorate %scale SpecId 1
               OpDecorate %block Block
               OpMemberDecorate %block 0 Offset 0
               OpDecorate %out DescriptorSet 0
               OpDecorate %out Binding 0
       %void = OpTypeVoid
       %bool = OpTypeBool
      %float = OpTypeFloat 32
        %int = OpTypeInt 32 1
       %zero = OpConstant %int 0
         %of = OpTypeFunction %float
    %program = OpTypeFunction %void
  %is_chosen = OpSpecConstantTrue %bool
      %scale = OpSpecConstant %float 1
        %two = OpConstant %float 2
      %seven = OpConstant %float 7
      %block = OpTypeStruct %float
 %to_a_block = OpTypePointer StorageBuffer %block
 %to_a_float = OpTypePointer StorageBuffer %float
        %out = OpVariable %to_a_block StorageBuffer
     %chosen = OpFunction %float None %of
    %label_a = OpLabel
               OpReturnValue %two
               OpFunctionEnd
      %other = OpFunction %float None %of
    %label_b = OpLabel
               OpReturnValue %seven
               OpFunctionEnd
       %main = OpFunction %void None %program
      %start = OpLabel
      %place = OpAccessChain %to_a_float %out %zero
               OpSelectionMerge %after None
               OpBranchConditional %is_chosen %if %else
         %if = OpLabel
          %a = OpFunctionCall %float %chosen
               OpBranch %after
       %else = OpLabel
          %b = OpFunctionCall %float %other
               OpBranch %after
      %after = OpLabel
      %value = OpPhi %float %a %if %b %else
     %scaled = OpFMul %float %value %scale
               OpStore %place %scaled
               OpReturn
               OpFunctionEnd
)";

/// The shader above for these constants, as text.
std::string specialized(std::vector<SpecConstant> constants) {
    const spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
    std::vector<uint32_t> code;
    EXPECT_TRUE(tools.Assemble(shader, &code));
    const std::vector<uint32_t> result = specialize(code, constants);
    EXPECT_TRUE(tools.Validate(result));
    std::string read;
    EXPECT_TRUE(tools.Disassemble(result, &read, SPV_BINARY_TO_TEXT_OPTION_FRIENDLY_NAMES));
    return read;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Specialize, LeavesWhatTheConstantsCallAndNoMore) {
    const std::string with = specialized({{0, 1}, {1, std::bit_cast<uint32_t>(0.25f)}});
    EXPECT_TRUE(contains(with, "OpFunctionCall %float %chosen"));
    EXPECT_FALSE(contains(with, "%other"));
    EXPECT_TRUE(contains(with, "OpConstant %float 0.25"));
    EXPECT_FALSE(contains(with, "OpSpecConstant"));
    const std::string without = specialized({{0, 0}, {1, std::bit_cast<uint32_t>(-3.0f)}, {7, 5}});
    EXPECT_TRUE(contains(without, "OpFunctionCall %float %other"));
    EXPECT_FALSE(contains(without, "%chosen"));
    EXPECT_TRUE(contains(without, "OpConstant %float -3"));
}

TEST(Specialize, TakesTheDefaultOfAConstantThatIsNotGiven) {
    const std::string of_defaults = specialized({});
    EXPECT_TRUE(contains(of_defaults, "%chosen"));
    EXPECT_FALSE(contains(of_defaults, "%other"));
    EXPECT_FALSE(contains(of_defaults, "OpSpecConstant"));
}

TEST(Specialize, RefusesWhatIsNoShader) {
    EXPECT_THROW(specialize({}, {}), Error);
    EXPECT_THROW(specialize(std::vector<uint32_t>{1, 2, 3, 4, 5, 6}, {}), Error);
}

}  // namespace
}  // namespace lw
