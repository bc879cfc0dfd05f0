#include "gather/gather_pass.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "gather.comp.spv.h"
#include "gather_queries.comp.spv.h"
#include "gpu/commands.h"
#include "size_lists.comp.spv.h"

namespace lw {
namespace {

using Stage = vk::PipelineStageFlagBits2;

/// A pipeline to be made, and the constants in which it differs from the others.
struct StagePipeline {
    vk::UniquePipeline* pipeline;
    uint stage;
    bool of_followed;
};

}  // namespace

FrameConstants constants_for(const Resident& resident, const GatherSettings& settings) {
    FrameConstants constants = resident.constants();
    constants.gather_mode = settings.mode;
    constants.heap_size = settings.mode == gather_mode_exact ? std::bit_ceil(std::max(1u, settings.neighbours)) : 1u;
    constants.has_shadow_rays = has_shadow_rays(settings, constants.has_visible_lamps);
    constants.followed_roughness = followed_roughness(settings);
    constants.has_followed = settings.mode != gather_mode_inspect &&
                             (resident.min_lobe() < followed_roughness(settings) || constants.follows_through);
    return constants;
}

Frame with_gather(Frame frame, const Resident& resident, const GatherSettings& settings, uint lamps) {
    frame.neighbours = std::max(1u, settings.neighbours);
    frame.inverse_flux_scale = resident.inverse_flux_scale();
    frame.ray_epsilon = resident.ray_epsilon();
    frame.scene_size = resident.scene_size();
    frame.shadow_rays = settings.shadow_rays;
    frame.inverse_irradiance_scale = resident.inverse_irradiance_scale(lamps);
    frame.triangle_limit = resident.triangle_count();
    frame.following = pack_following({0, 0, 0, std::clamp(settings.paths, 1u, max_paths)});
    return frame;
}

GatherPass::GatherPass(const Device& device, const Resident& resident, const Picture& picture, GatherSettings settings)
    : resident_(&resident), picture_(&picture), ray_pairs_(ray_pairs(uint(resident.scene().lights.size()))) {
    if (settings.mode == gather_mode_exact && settings.neighbours > max_exact_neighbours)
        throw Error("gather: exact search takes at most " + std::to_string(max_exact_neighbours) + " neighbours");
    const vk::DescriptorSetLayout sets[] = {resident.descriptors().layout(), picture.descriptors().layout()};
    layout_ = make_layout(device, sets, vk::ShaderStageFlagBits::eCompute, sizeof(Frame));
    const FrameConstants constants = constants_for(resident, settings);
    const bool has_rays = settings.mode != gather_mode_inspect && constants.has_direct;
    const bool follows = constants.has_followed;
    if (has_rays || follows) sizes_ = make_compute_pipeline(device, *layout_, size_lists_comp, {});
    std::vector<StagePipeline> wanted{{&photons_, stage_photons, false}};
    if (has_rays) wanted.push_back({&rays_, stage_rays, false});
    if (follows) wanted.push_back({&follow_, stage_follow, false});
    if (follows) wanted.push_back({&followed_photons_, stage_photons, true});
    if (follows && has_rays) wanted.push_back({&followed_rays_, stage_rays, true});
    const SpirV code = resident.queries_rays() ? SpirV(gather_queries_comp) : SpirV(gather_comp);
    parallel_for(wanted.size(), [&](size_t i) {  // each takes a tenth of a second where the driver is slow
        FrameConstants own = constants;
        own.stage = wanted[i].stage;
        own.of_followed = wanted[i].of_followed;
        *wanted[i].pipeline = make_compute_pipeline(device, *layout_, code, spec_constants_of(own));
    });
    if (!follows) return;
    const bool follows_lobes = followed_roughness(settings) > std::sqrt(min_alpha);  // not only mirrors and glass
    lobes_ = follows_lobes ? max_lobes : 1;
    has_branch_[branch_reflected] = resident.min_lobe() < followed_roughness(settings);
    has_branch_[branch_through] = constants.follows_through;
}

void GatherPass::record(vk::CommandBuffer commands, const Frame& frame, const Picture& picture, uint lamps,
                        Rows rows) const {
    const vk::DescriptorSet sets[] = {resident_->descriptors(lamps).handle(), picture.descriptors().handle()};
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, sets, {});
    commands.pushConstants<Frame>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, frame);
    if (rays_ || follow_) empty_lists(commands, picture, ray_pairs_ + (follow_ ? branch_count : 0));
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *photons_);
    const auto groups = [](uint pixels) { return (pixels + gather_group_side - 1) / gather_group_side; };
    const uint first = rows.first / gather_group_side, end = groups(std::min(rows.end, frame.height));
    commands.dispatchBase(0, first, 0, groups(frame.width), end - first, 1);
    if (sizes_) size_lists(commands);
    if (rays_) record_rays(commands, picture, *rays_);
    if (!follow_) return;
    const uint paths = unpack_following(frame.following).paths;
    for (uint branch = 0; branch < branch_count; ++branch)
        for (uint path = 0; has_branch_[branch] && path < paths; ++path)
            for (uint depth = 0; depth < lobes_; ++depth) record_path(commands, picture, {branch, depth, path, paths});
}

void GatherPass::empty_lists(vk::CommandBuffer commands, const Picture& picture, uint lists) const {
    stage_barrier(commands, Stage::eComputeShader | Stage::eDrawIndirect, Stage::eTransfer);
    commands.updateBuffer<RayPixels>(picture.ray_lists().handle(), 0, std::vector<RayPixels>(lists, {0, 1, 1, 0}));
    stage_barrier(commands, Stage::eTransfer, Stage::eComputeShader);
}

void GatherPass::size_lists(vk::CommandBuffer commands) const {
    stage_barrier(commands, Stage::eComputeShader, Stage::eComputeShader);
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *sizes_);
    commands.dispatch(1, 1, 1);
}

void GatherPass::record_rays(vk::CommandBuffer commands, const Picture& picture, vk::Pipeline rays) const {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, rays);
    for (uint pair = 0; pair < ray_pairs_; ++pair) {
        commands.pushConstants(*layout_, vk::ShaderStageFlagBits::eCompute, offsetof(Frame, ray_pair), sizeof pair,
                               &pair);
        dispatch_list(commands, picture, pair);
    }
}

void GatherPass::record_path(vk::CommandBuffer commands, const Picture& picture, const Following& following) const {
    const uint packed = pack_following(following), list = ray_pairs_ + following.branch;
    empty_lists(commands, picture, ray_pairs_);
    commands.pushConstants(*layout_, vk::ShaderStageFlagBits::eCompute, offsetof(Frame, following), sizeof packed,
                           &packed);
    for (const vk::Pipeline pipeline : {*follow_, *followed_photons_}) {
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipeline);
        dispatch_list(commands, picture, list);
    }
    if (!followed_rays_) return;
    size_lists(commands);
    record_rays(commands, picture, *followed_rays_);
}

void GatherPass::dispatch_list(vk::CommandBuffer commands, const Picture& picture, uint list) const {
    stage_barrier(commands, Stage::eComputeShader, Stage::eComputeShader | Stage::eDrawIndirect);
    commands.dispatchIndirect(picture.ray_lists().handle(), list * sizeof(RayPixels));
}

}  // namespace lw
