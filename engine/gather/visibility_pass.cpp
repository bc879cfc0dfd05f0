#include "gather/visibility_pass.h"

#include "gpu/commands.h"
#include "visibility.frag.spv.h"
#include "visibility.vert.spv.h"

namespace lw {
namespace {

using Stage = vk::PipelineStageFlagBits2;
using Layout = vk::ImageLayout;

constexpr auto both_stages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
constexpr auto depth_tests = Stage::eEarlyFragmentTests | Stage::eLateFragmentTests;

}  // namespace

VisibilityPass::VisibilityPass(const Device& device, const Resident& resident, vk::Extent2D size, size_t culled_from)
    : device_(&device),
      resident_(&resident),
      cull_(device, resident, culled_from),
      visible_(device, size, vk::Format::eR32G32B32A32Uint,
               vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled |
                   vk::ImageUsageFlagBits::eTransferSrc),
      depth_(device, size, vk::Format::eD32Sfloat, vk::ImageUsageFlagBits::eDepthStencilAttachment) {
    const vk::DescriptorSetLayout sets[] = {resident.descriptors().layout(), cull_.descriptors().layout()};
    layout_ = make_layout(device, sets, both_stages, sizeof(Frame));
    for (const bool see_through : {false, true}) {
        FrameConstants constants = resident.constants();
        constants.first_listed = cull_.first_listed(see_through);
        if (!see_through) constants.has_alpha = constants.has_transmission = false;
        pipelines_[see_through] =
            make_raster_pipeline(device, *layout_, {visibility_vert, visibility_frag}, spec_constants_of(constants),
                                 visible_.format(), depth_.format());
    }
}

void VisibilityPass::record(vk::CommandBuffer commands, const Frame& frame) const {
    cull_.record(commands, frame);
    visible_.change_layout(commands, Layout::eUndefined, Layout::eColorAttachmentOptimal,
                           Stage::eComputeShader | Stage::eTransfer, Stage::eColorAttachmentOutput);
    depth_.change_layout(commands, Layout::eUndefined, Layout::eDepthAttachmentOptimal, depth_tests, depth_tests);
    draw(commands, frame);
    visible_.change_layout(commands, Layout::eColorAttachmentOptimal, Layout::eShaderReadOnlyOptimal,
                           Stage::eColorAttachmentOutput, Stage::eComputeShader);
}

void VisibilityPass::draw(vk::CommandBuffer commands, const Frame& frame) const {
    const vk::Extent2D size{frame.width, frame.height};
    vk::RenderingAttachmentInfo color(visible_.view(), Layout::eColorAttachmentOptimal);
    color.setLoadOp(vk::AttachmentLoadOp::eClear).setStoreOp(vk::AttachmentStoreOp::eStore);
    color.clearValue.color.setUint32({no_triangle, 0u, 0u, 0u});
    vk::RenderingAttachmentInfo depth(depth_.view(), Layout::eDepthAttachmentOptimal);
    depth.setLoadOp(vk::AttachmentLoadOp::eClear).setStoreOp(vk::AttachmentStoreOp::eDontCare);
    depth.clearValue.depthStencil = vk::ClearDepthStencilValue(0.0f, 0);
    commands.beginRendering(vk::RenderingInfo({}, {{0, 0}, size}, 1, 0, color, &depth));
    commands.setViewport(0, vk::Viewport(0, 0, float(size.width), float(size.height), 0, 1));
    commands.setScissor(0, vk::Rect2D({0, 0}, size));
    const vk::DescriptorSet sets[] = {resident_->descriptors().handle(), cull_.descriptors().handle()};
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, sets, {});
    commands.pushConstants<Frame>(*layout_, both_stages, 0, frame);
    for (const bool see_through : {false, true}) {
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines_[see_through]);
        cull_.draw(commands, see_through);
    }
    commands.endRendering();
}

std::vector<VisibleSample> VisibilityPass::read_samples() const {
    const vk::Extent2D size = visible_.size();
    const size_t count = size_t(size.width) * size.height;
    const Buffer pixels(*device_, count * sizeof(VisibleSample), "visible triangles");
    submit_and_wait(*device_, [&](vk::CommandBuffer commands) {
        visible_.change_layout(commands, Layout::eShaderReadOnlyOptimal, Layout::eTransferSrcOptimal,
                               Stage::eAllCommands, Stage::eTransfer);
        const vk::BufferImageCopy whole(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {},
                                        {size.width, size.height, 1});
        commands.copyImageToBuffer(visible_.image(), Layout::eTransferSrcOptimal, pixels.handle(), whole);
        visible_.change_layout(commands, Layout::eTransferSrcOptimal, Layout::eShaderReadOnlyOptimal, Stage::eTransfer,
                               Stage::eAllCommands);
    });
    return read_back<VisibleSample>(*device_, pixels, count);
}

}  // namespace lw
