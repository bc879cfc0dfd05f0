#include "gather/frame_renderer.h"

#include <cmath>

#include "gather/device_fit.h"
#include "gather/renderer.h"

namespace lw {

using Stage = vk::PipelineStageFlagBits2;

FrameRenderer::FrameRenderer(const Device& device, const Resident& resident, vk::Extent2D size)
    : device_(&device),
      resident_(&resident),
      size_(fit_pictures(device, resident, size, 2)),
      visibility_(device, resident, size),
      a_(device, visibility_.texture(), resident),
      b_(device, visibility_.texture(), resident),
      view_(device, visibility_.texture(), a_, b_) {}

void FrameRenderer::record_visibility(vk::CommandBuffer commands, const Frame& frame) const {
    stage_barrier(commands, Stage::eAllCommands, Stage::eAllCommands);  // the frame before still reads the pictures
    visibility_.record(commands, frame);
}

GatherPass& FrameRenderer::pass_for(const GatherSettings& settings) {
    std::unique_ptr<GatherPass>& pass = passes_[pipeline_settings(settings)];
    if (!pass) pass = std::make_unique<GatherPass>(*device_, *resident_, a_, settings);
    return *pass;
}

void FrameRenderer::record_light(vk::CommandBuffer commands, const Frame& frame, const GatherSettings& settings,
                                 Side side, uint lamps, Rows rows) {
    stage_barrier(commands, Stage::eAllCommands, Stage::eComputeShader);
    GatherSettings gather = settings;
    Frame sample = frame;
    if (settings.shadow_rays > 0 && resident_->min_lobe() < settings.followed_roughness) {
        if (frame.sample_index == 0) gather.followed_roughness = std::sqrt(min_alpha);
        if (frame.sample_index == 1) sample.sample_index = 0, sample.sample_weight *= 2;  // in the place of the first
    }
    pass_for(gather).record(commands, with_gather(sample, *resident_, gather, lamps), side == Side::a ? a_ : b_, lamps,
                            rows);
}

void FrameRenderer::record_view(vk::CommandBuffer commands, const ViewKind& kind, const ViewPush& push, uint slot) {
    stage_barrier(commands, Stage::eAllCommands, Stage::eComputeShader);
    view_.record(commands, kind, push, slot);
    stage_barrier(commands, Stage::eAllCommands, Stage::eTransfer | Stage::eHost);
}

Image FrameRenderer::read_values(const Camera& camera, vk::Extent2D picture_size, uint samples, uint fresh_rows) const {
    const std::vector<VisibleSample> whole = visibility_.read_samples();
    std::vector<VisibleSample> visible;
    for (uint y = 0; y < picture_size.height; ++y)
        visible.insert(visible.end(), whole.begin() + y * size_.width,
                       whole.begin() + y * size_.width + picture_size.width);
    Image image = read_picture(*device_, resident_->scene(), camera, a_, picture_size, visible);
    for (Channel& channel : image.channels)
        if (channel.name == "R" || channel.name == "G" || channel.name == "B" || channel.name == "illuminance")
            for (size_t i = 0; i < channel.values.size(); ++i)
                channel.values[i] /= float(samples + (i < size_t(fresh_rows) * picture_size.width ? 1 : 0));
    return image;
}

}  // namespace lw
