#include "gather/gather_pass.h"

#include <algorithm>
#include <bit>

#include "base/error.h"
#include "gather.comp.spv.h"
#include "gpu/commands.h"

namespace lw {
namespace {

ShaderConstants with_mode(ShaderConstants constants, GatherSettings settings) {
    constants[constant_gather_mode] = settings.mode;
    constants[constant_heap_size] = settings.mode == 0 ? std::bit_ceil(std::max(1u, settings.neighbours)) : 1u;
    constants[constant_has_shadow_rays] = settings.shadow_rays > 0;
    return constants;
}

}  // namespace

Frame with_gather(Frame frame, const Resident& resident, const GatherSettings& settings, uint lamps) {
    frame.neighbours = std::max(1u, settings.neighbours);
    frame.max_radius = resident.max_radius();
    frame.inverse_flux_scale = resident.inverse_flux_scale();
    frame.ray_epsilon = resident.ray_epsilon();
    frame.scene_size = resident.scene_size();
    frame.shadow_rays = settings.shadow_rays;
    frame.inverse_irradiance_scale = resident.inverse_irradiance_scale(lamps);
    frame.triangle_limit = resident.triangle_count();
    return frame;
}

GatherPass::GatherPass(const Device& device, const Resident& resident, const Picture& picture, GatherSettings settings)
    : resident_(&resident), picture_(&picture) {
    if (settings.mode == 0 && settings.neighbours > PhotonEstimator::heap_size)
        throw Error("gather: exact search takes at most " + std::to_string(PhotonEstimator::heap_size) + " neighbours");
    const vk::DescriptorSetLayout sets[] = {resident.descriptors().layout(), picture.descriptors().layout()};
    layout_ = make_layout(device, sets, vk::ShaderStageFlagBits::eCompute, sizeof(Frame));
    ShaderConstants constants = with_mode(resident.constants(), settings);
    const bool has_rays =
        settings.mode != gather_mode_inspect && (constants[constant_has_direct] || constants[constant_has_mirrors]);
    for (uint stage = stage_photons; stage <= (has_rays ? stage_rays : stage_photons); ++stage) {
        constants[constant_stage] = stage;
        stages_.push_back(make_compute_pipeline(device, *layout_, gather_comp, constants));
    }
}

void GatherPass::record(vk::CommandBuffer commands, const Frame& frame, const Picture& picture, uint lamps) const {
    using Stage = vk::PipelineStageFlagBits2;
    const vk::DescriptorSet sets[] = {resident_->descriptors(lamps).handle(), picture.descriptors().handle()};
    const uint words = ray_words(uint(resident_->scene().lights.size()));
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, sets, {});
    commands.pushConstants<Frame>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, frame);
    if (stages_.size() > 1) {
        const std::vector<RayPixels> empty(words, {0, 1, 1, 0});
        commands.updateBuffer<RayPixels>(picture.ray_lists().handle(), 0, empty);
        stage_barrier(commands, Stage::eTransfer, Stage::eComputeShader);
    }
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *stages_[stage_photons]);
    const auto groups = [](uint pixels) { return (pixels + gather_group_side - 1) / gather_group_side; };
    commands.dispatch(groups(frame.width), groups(frame.height), 1);
    if (stages_.size() == 1) return;
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *stages_[stage_rays]);
    for (uint word = 0; word < words; ++word) {
        stage_barrier(commands, Stage::eComputeShader, Stage::eComputeShader | Stage::eDrawIndirect);
        commands.pushConstants(*layout_, vk::ShaderStageFlagBits::eCompute, offsetof(Frame, ray_word), sizeof word,
                               &word);
        commands.dispatchIndirect(picture.ray_lists().handle(), word * sizeof(RayPixels));
    }
}

}  // namespace lw
