#include "gather/view_pass.h"

#include "gather/bindings.h"
#include "gather/constants.h"
#include "gpu/commands.h"
#include "view.comp.spv.h"

namespace lw {
namespace {

constexpr size_t readback_bytes = size_t(readback_columns) * readback_rows * sizeof(ReadbackPixel);

}  // namespace

ViewPass::ViewPass(const Device& device, const Target& visibility, const Picture& a, const Picture& b)
    : device_(&device),
      readback_(upload<ReadbackPixel>(device, std::vector<ReadbackPixel>(readback_bytes / sizeof(ReadbackPixel)),
                                      "readback")),
      read_back_{Buffer(device, readback_bytes, "readback", Buffer::Place::host),
                 Buffer(device, readback_bytes, "readback", Buffer::Place::host)},
      descriptors_(device, bindings_of(BindingSet::view)) {
    for (const Buffer& buffer : read_back_) std::fill_n(static_cast<char*>(buffer.mapped()), readback_bytes, char(0));
    descriptors_.set_texels(binding_view_light, a.light());
    descriptors_.set_texels(binding_view_other, b.light());
    descriptors_.set_target(binding_view_visibility, visibility);
    descriptors_.set_buffer(binding_view_screen, a.screen());
    descriptors_.set_buffer(binding_view_readback, readback_);
    const vk::DescriptorSetLayout sets[] = {descriptors_.layout()};
    layout_ = make_layout(device, sets, vk::ShaderStageFlagBits::eCompute, sizeof(ViewPush));
}

vk::Pipeline ViewPass::pipeline_for(const ViewKind& kind, bool is_scaled, bool is_readback) {
    vk::UniquePipeline& pipeline = pipelines_[{kind, is_scaled, is_readback}];
    if (!pipeline) {
        ViewConstants constants;
        constants.shown_view = kind.view;
        constants.shown_curve = kind.curve;
        constants.has_lines = kind.has_lines;
        constants.has_split = kind.has_split && !is_inspection(kind.view) && !is_signed_view(kind.view);
        constants.is_scaled = is_scaled;
        constants.is_readback = is_readback;
        pipeline = make_compute_pipeline(*device_, *layout_, view_comp, spec_constants_of(constants));
    }
    return *pipeline;
}

void ViewPass::record(vk::CommandBuffer commands, const ViewKind& kind, const ViewPush& push, uint slot) {
    const bool is_scaled = push.screen != push.picture;
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, descriptors_.handle(), {});
    commands.pushConstants<ViewPush>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, push);
    for (const bool is_readback : {false, true}) {
        const uvec2 invocations = is_readback ? uvec2(readback_columns, readback_rows) : push.screen;
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipeline_for(kind, is_scaled, is_readback));
        commands.dispatch((invocations.x + 7) / 8, (invocations.y + 7) / 8, 1);
    }
    stage_barrier(commands, vk::PipelineStageFlagBits2::eComputeShader, vk::PipelineStageFlagBits2::eTransfer);
    commands.copyBuffer(readback_.handle(), read_back_[slot].handle(), vk::BufferCopy(0, 0, readback_bytes));
}

std::vector<ReadbackPixel> ViewPass::readback(uint slot) const {
    const auto* first = static_cast<const ReadbackPixel*>(read_back_[slot].mapped());
    return {first, first + readback_bytes / sizeof(ReadbackPixel)};
}

}  // namespace lw
