#include "gpu/target.h"

#include "base/error.h"

namespace lw {
namespace {

vk::ImageSubresourceRange whole(vk::Format format) {
    const bool depth = format == vk::Format::eD32Sfloat;
    return {depth ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1};
}

std::string size_text(vk::Extent2D size) { return std::to_string(size.width) + "x" + std::to_string(size.height); }

}  // namespace

Target::Target(const Device& device, vk::Extent2D size, vk::Format format, vk::ImageUsageFlags usage)
    : size_(size), format_(format) {
    const uint32_t limit = device.limits().maxImageDimension2D;
    if (size.width > limit || size.height > limit)
        throw Error(device.name() + ": a picture of " + size_text(size) + " is too large, the limit is " +
                    size_text({limit, limit}));
    const vk::Device d = device.handle();
    try {
        image_ = d.createImageUnique({{},
                                      vk::ImageType::e2D,
                                      format,
                                      {size.width, size.height, 1},
                                      1,
                                      1,
                                      vk::SampleCountFlagBits::e1,
                                      vk::ImageTiling::eOptimal,
                                      usage});
        const vk::MemoryRequirements needs = d.getImageMemoryRequirements(*image_);
        const int type = device.find_memory_type(needs.memoryTypeBits, vk::MemoryPropertyFlagBits::eDeviceLocal);
        if (type < 0) throw Error(device.name() + ": has no memory for pictures");
        memory_ = d.allocateMemoryUnique({needs.size, uint32_t(type)});
        d.bindImageMemory(*image_, *memory_, 0);
        view_ = d.createImageViewUnique({{}, *image_, vk::ImageViewType::e2D, format, {}, whole(format)});
    } catch (const vk::SystemError& failure) {
        throw Error(device.name() + ": no memory for a picture of " + size_text(size) + ": " + failure.what());
    }
}

void Target::change_layout(vk::CommandBuffer commands, vk::ImageLayout before, vk::ImageLayout after,
                           vk::PipelineStageFlags2 from, vk::PipelineStageFlags2 to) const {
    const vk::ImageMemoryBarrier2 barrier(from, vk::AccessFlagBits2::eMemoryWrite, to,
                                          vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite, before,
                                          after, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, *image_,
                                          whole(format_));
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
}

}  // namespace lw
