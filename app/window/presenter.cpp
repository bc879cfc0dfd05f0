#include "app/window/presenter.h"

#include "base/error.h"

namespace lw {
namespace {

using Layout = vk::ImageLayout;
using Stage = vk::PipelineStageFlagBits2;
using Access = vk::AccessFlagBits2;

constexpr vk::ImageSubresourceRange whole_color{vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1};

void change_layout(vk::CommandBuffer commands, vk::Image image, Layout before, Layout after,
                   vk::PipelineStageFlags2 from, vk::PipelineStageFlags2 to) {
    const vk::ImageMemoryBarrier2 barrier(from, Access::eMemoryWrite, to, Access::eMemoryRead | Access::eMemoryWrite,
                                          before, after, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image,
                                          whole_color);
    commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
}

void wait_for(const Device& device, vk::Fence fence) {
    if (device.handle().waitForFences(fence, true, UINT64_MAX) != vk::Result::eSuccess)
        throw Error(device.name() + ": does not finish its work");
}

}  // namespace

Presenter::Presenter(const Device& device, const Window& window, bool vsync)
    : device_(&device), window_(&window), vsync_(vsync), surface_(window.make_surface(device)) {
    for (Slot& slot : slots_) {
        slot.pool =
            device.handle().createCommandPoolUnique({vk::CommandPoolCreateFlagBits::eTransient, device.queue_family()});
        slot.done = device.handle().createFenceUnique({vk::FenceCreateFlagBits::eSignaled});
        slot.available = device.handle().createSemaphoreUnique({});
    }
    make_swapchain();
}

Presenter::~Presenter() {
    try {
        device_->handle().waitIdle();
    } catch (const vk::SystemError&) {  // the device is lost: there is nothing to wait for
    }
}

void Presenter::make_swapchain() {
    device_->handle().waitIdle();
    swapchain_.reset();
    swapchain_.emplace(*device_, *surface_, window_->size(), vsync_);
    finished_.clear();
    for (uint32_t i = 0; i < swapchain_->count(); ++i) finished_.push_back(device_->handle().createSemaphoreUnique({}));
    ++generation_;
    outdated_ = false;
}

vk::CommandBuffer Presenter::begin_commands(Slot& slot) const {
    auto made = device_->handle().allocateCommandBuffersUnique({*slot.pool, vk::CommandBufferLevel::ePrimary, 1});
    slot.commands.push_back(std::move(made[0]));
    slot.commands.back()->begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    return *slot.commands.back();
}

std::optional<OpenFrame> Presenter::begin() {
    const vk::Extent2D wanted = window_->size();
    if (wanted.width == 0 || wanted.height == 0) return std::nullopt;
    const vk::Extent2D now = surface_size(*device_, *surface_, wanted);
    if (now.width == 0 || now.height == 0) return std::nullopt;
    if (outdated_ || now != swapchain_->size()) make_swapchain();
    Slot& slot = slots_[next_slot_];
    wait_for(*device_, *slot.done);
    const std::optional<uint32_t> image = swapchain_->acquire(*slot.available);
    if (!image) {
        outdated_ = true;
        return std::nullopt;
    }
    device_->handle().resetFences(*slot.done);
    slot.commands.clear();
    const OpenFrame frame{begin_commands(slot), next_slot_, *image};
    next_slot_ = (next_slot_ + 1) % slots;
    return frame;
}

void Presenter::flush(OpenFrame& frame) {
    frame.commands.end();
    const vk::CommandBufferSubmitInfo commands(frame.commands);
    const vk::UniqueFence fence = device_->handle().createFenceUnique({});
    device_->queue().submit2(vk::SubmitInfo2({}, {}, commands, {}), *fence);
    wait_for(*device_, *fence);
    frame.commands = begin_commands(slots_[frame.slot]);
}

void Presenter::record_copy(const OpenFrame& frame, const Buffer* picture) const {
    const vk::Image image = swapchain_->image(frame.image);
    const vk::Extent2D size = swapchain_->size();
    change_layout(frame.commands, image, Layout::eUndefined, Layout::eTransferDstOptimal, Stage::eAllTransfer,
                  Stage::eAllTransfer);
    if (picture) {
        const vk::BufferImageCopy whole(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {},
                                        {size.width, size.height, 1});
        frame.commands.copyBufferToImage(picture->handle(), image, Layout::eTransferDstOptimal, whole);
    } else {
        const vk::ClearColorValue dark(std::array<float, 4>{0.05f, 0.05f, 0.06f, 1.0f});
        frame.commands.clearColorImage(image, Layout::eTransferDstOptimal, dark, whole_color);
    }
    change_layout(frame.commands, image, Layout::eTransferDstOptimal, Layout::eColorAttachmentOptimal,
                  Stage::eAllTransfer, Stage::eColorAttachmentOutput);
}

void Presenter::record_keep(const OpenFrame& frame) {
    const vk::Extent2D size = swapchain_->size();
    const vk::DeviceSize bytes = vk::DeviceSize(4) * size.width * size.height;
    if (kept_.size() != bytes) kept_ = Buffer(*device_, bytes, "screenshot", Buffer::Place::host);
    const vk::Image image = swapchain_->image(frame.image);
    change_layout(frame.commands, image, Layout::eColorAttachmentOptimal, Layout::eTransferSrcOptimal,
                  Stage::eColorAttachmentOutput, Stage::eAllTransfer);
    const vk::BufferImageCopy whole(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {},
                                    {size.width, size.height, 1});
    frame.commands.copyImageToBuffer(image, Layout::eTransferSrcOptimal, kept_.handle(), whole);
    stage_barrier(frame.commands, Stage::eAllTransfer, Stage::eHost);
    change_layout(frame.commands, image, Layout::eTransferSrcOptimal, Layout::eColorAttachmentOptimal,
                  Stage::eAllTransfer, Stage::eColorAttachmentOutput);
}

void Presenter::end(const OpenFrame& frame, const Buffer* picture,
                    const std::function<void(vk::CommandBuffer)>& draw_over, bool keep_shown) {
    const Slot& slot = slots_[frame.slot];
    record_copy(frame, picture);
    draw_over(frame.commands);
    if (keep_shown) record_keep(frame);
    change_layout(frame.commands, swapchain_->image(frame.image), Layout::eColorAttachmentOptimal,
                  Layout::ePresentSrcKHR, Stage::eColorAttachmentOutput, Stage::eAllCommands);
    frame.commands.end();
    const vk::SemaphoreSubmitInfo wait(*slot.available, 0, Stage::eAllTransfer);
    const vk::SemaphoreSubmitInfo signal(*finished_[frame.image], 0, Stage::eAllCommands);
    const vk::CommandBufferSubmitInfo commands(frame.commands);
    device_->queue().submit2(vk::SubmitInfo2({}, wait, commands, signal), *slot.done);
    if (!swapchain_->present(frame.image, *finished_[frame.image])) outdated_ = true;
}

Rgb8Image Presenter::shown() const {
    device_->handle().waitIdle();
    const vk::Extent2D size = swapchain_->size();
    Rgb8Image image{int(size.width), int(size.height), {}};
    const auto* bytes = static_cast<const uint8_t*>(kept_.mapped());
    for (size_t i = 0; i < image.pixel_count(); ++i)
        for (size_t c = 0; c < 3; ++c) image.rgb.push_back(bytes[4 * i + (swapchain_->is_bgr() ? 2 - c : c)]);
    return image;
}

}  // namespace lw
