// A picture in device memory that a pass renders into and a later pass reads.
#pragma once
#include "gpu/device.h"

namespace lw {

/// Owns a 2D image with one level, its memory and a view of it.
class Target {
  public:
    /// Throws Error when the size is beyond the device's limits or memory.
    Target(const Device& device, vk::Extent2D size, vk::Format format, vk::ImageUsageFlags usage);

    vk::Image image() const { return *image_; }
    vk::ImageView view() const { return *view_; }
    vk::Extent2D size() const { return size_; }
    vk::Format format() const { return format_; }
    /// Records a change of layout from `before` to `after`; stage `from` of earlier commands ends before stage `to` of
    /// later ones begins. With `before` = eUndefined the content is lost.
    void change_layout(vk::CommandBuffer commands, vk::ImageLayout before, vk::ImageLayout after,
                       vk::PipelineStageFlags2 from, vk::PipelineStageFlags2 to) const;

  private:
    vk::Extent2D size_;
    vk::Format format_;
    vk::UniqueDeviceMemory memory_;
    vk::UniqueImage image_;
    vk::UniqueImageView view_;
};

}  // namespace lw
