#include "gpu/specialize.h"

#include <spirv-tools/optimizer.hpp>

#include "base/error.h"

namespace lw {

std::vector<uint32_t> specialize(SpirV code, SpecConstants constants) {
    std::unordered_map<uint32_t, std::vector<uint32_t>> values;
    for (const SpecConstant& c : constants) values[c.id] = {c.bits};
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_3);
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
        .RegisterPass(spvtools::CreateLocalSingleStoreElimPass())
        .RegisterPass(spvtools::CreateCCPPass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateBlockMergePass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    std::vector<uint32_t> specialized;
    if (!optimizer.Run(code.data(), code.size(), &specialized, options)) throw Error("shader: is no SPIR-V");
    return specialized;
}

}  // namespace lw
