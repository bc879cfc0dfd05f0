#include "gather/tonemap_pass.h"

#include "tonemap.comp.spv.h"

namespace lw {

TonemapPass::TonemapPass(const Device& device, const Resident& resident, const Picture& picture) : picture_(&picture) {
    const vk::DescriptorSetLayout sets[] = {resident.descriptors().layout(), picture.descriptors().layout()};
    layout_ = make_layout(device, sets, vk::ShaderStageFlagBits::eCompute, sizeof(Screen));
    pipeline_ = make_compute_pipeline(device, *layout_, tonemap_comp, {});
}

void TonemapPass::record(vk::CommandBuffer commands, const Screen& screen) const {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 1, picture_->descriptors().handle(), {});
    commands.pushConstants<Screen>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, screen);
    commands.dispatch((screen.width + 7) / 8, (screen.height + 7) / 8, 1);
}

}  // namespace lw
