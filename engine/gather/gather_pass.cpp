#include "gather/gather_pass.h"

#include <algorithm>
#include <bit>

#include "base/error.h"
#include "gather.comp.spv.h"

namespace lw {
namespace {

ShaderConstants with_mode(ShaderConstants constants, GatherSettings settings) {
    constants[constant_gather_mode] = settings.mode;
    constants[constant_heap_size] = settings.mode == 0 ? std::bit_ceil(std::max(1u, settings.neighbours)) : 1u;
    constants[constant_has_shadow_rays] = settings.shadow_rays > 0;
    return constants;
}

}  // namespace

Frame with_gather(Frame frame, const Resident& resident, const GatherSettings& settings) {
    frame.neighbours = std::max(1u, settings.neighbours);
    frame.max_radius = resident.max_radius();
    frame.inverse_flux_scale = resident.inverse_flux_scale();
    frame.ray_epsilon = resident.ray_epsilon();
    frame.scene_size = resident.scene_size();
    frame.shadow_rays = settings.shadow_rays;
    frame.inverse_irradiance_scale = resident.inverse_irradiance_scale();
    frame.triangle_limit = resident.triangle_count();
    return frame;
}

GatherPass::GatherPass(const Device& device, const Resident& resident, const Picture& picture, GatherSettings settings)
    : resident_(&resident), picture_(&picture) {
    if (settings.mode == 0 && settings.neighbours > PhotonEstimator::heap_size)
        throw Error("gather: exact search takes at most " + std::to_string(PhotonEstimator::heap_size) + " neighbours");
    const vk::DescriptorSetLayout sets[] = {resident.descriptors().layout(), picture.descriptors().layout()};
    layout_ = make_layout(device, sets, vk::ShaderStageFlagBits::eCompute, sizeof(Frame));
    pipeline_ = make_compute_pipeline(device, *layout_, gather_comp, with_mode(resident.constants(), settings));
}

void GatherPass::record(vk::CommandBuffer commands, const Frame& frame, const Picture& picture) const {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
    const vk::DescriptorSet sets[] = {resident_->descriptors().handle(), picture.descriptors().handle()};
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, sets, {});
    commands.pushConstants<Frame>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, frame);
    commands.dispatch((frame.width + 7) / 8, (frame.height + 7) / 8, 1);
}

}  // namespace lw
