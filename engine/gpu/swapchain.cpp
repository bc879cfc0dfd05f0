#include "gpu/swapchain.h"

#include <algorithm>

#include "base/error.h"

namespace lw {
namespace {

constexpr auto usage = vk::ImageUsageFlagBits::eTransferDst | vk::ImageUsageFlagBits::eTransferSrc |
                       vk::ImageUsageFlagBits::eColorAttachment;

vk::SurfaceFormatKHR choose_format(const Device& device, vk::SurfaceKHR surface) {
    for (const vk::SurfaceFormatKHR& f : device.physical().getSurfaceFormatsKHR(surface))
        if ((f.format == vk::Format::eB8G8R8A8Unorm || f.format == vk::Format::eR8G8B8A8Unorm) &&
            f.colorSpace == vk::ColorSpaceKHR::eSrgbNonlinear)
            return f;
    throw Error(device.name() + ": the window has no 8-bit sRGB format");
}

vk::PresentModeKHR choose_mode(const Device& device, vk::SurfaceKHR surface, bool vsync) {
    if (vsync) return vk::PresentModeKHR::eFifo;
    const auto modes = device.physical().getSurfacePresentModesKHR(surface);
    for (vk::PresentModeKHR wanted : {vk::PresentModeKHR::eMailbox, vk::PresentModeKHR::eImmediate})
        if (std::find(modes.begin(), modes.end(), wanted) != modes.end()) return wanted;
    return vk::PresentModeKHR::eFifo;
}

[[noreturn]] void fail(const Device& device, VkResult result) {
    if (result == VK_ERROR_DEVICE_LOST) throw vk::DeviceLostError(device.name() + ": lost");
    throw Error(device.name() + ": cannot show the picture: " + vk::to_string(vk::Result(result)));
}

}  // namespace

vk::Extent2D surface_size(const Device& device, vk::SurfaceKHR surface, vk::Extent2D wanted) {
    const vk::SurfaceCapabilitiesKHR can = device.physical().getSurfaceCapabilitiesKHR(surface);
    if (can.currentExtent.width != 0xffffffffu) return can.currentExtent;
    return {std::clamp(wanted.width, can.minImageExtent.width, can.maxImageExtent.width),
            std::clamp(wanted.height, can.minImageExtent.height, can.maxImageExtent.height)};
}

Swapchain::Swapchain(const Device& device, vk::SurfaceKHR surface, vk::Extent2D wanted, bool vsync) : device_(&device) {
    if (!device.physical().getSurfaceSupportKHR(device.queue_family(), surface))
        throw Error(device.name() + ": cannot show pictures in this window");
    const vk::SurfaceCapabilitiesKHR can = device.physical().getSurfaceCapabilitiesKHR(surface);
    if ((can.supportedUsageFlags & usage) != usage) throw Error(device.name() + ": the window takes no copies");
    const vk::SurfaceFormatKHR format = choose_format(device, surface);
    format_ = format.format;
    size_ = surface_size(device, surface, wanted);
    const uint32_t most = can.maxImageCount ? can.maxImageCount : 8;
    vk::SwapchainCreateInfoKHR info({}, surface, std::min(std::max(can.minImageCount, 3u), most), format_,
                                    format.colorSpace, size_, 1, usage);
    info.preTransform = can.currentTransform;
    info.presentMode = choose_mode(device, surface, vsync);
    info.clipped = true;
    swapchain_ = device.handle().createSwapchainKHRUnique(info);
    images_ = device.handle().getSwapchainImagesKHR(*swapchain_);
    for (vk::Image image : images_)
        views_.push_back(device.handle().createImageViewUnique(
            {{}, image, vk::ImageViewType::e2D, format_, {}, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}}));
}

std::optional<uint32_t> Swapchain::acquire(vk::Semaphore available) const {
    uint32_t index = 0;
    const VkResult result = vkAcquireNextImageKHR(device_->handle(), *swapchain_, UINT64_MAX, available, {}, &index);
    if (result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR)
        return index;  // present() returns false for a suboptimal one
    if (result == VK_ERROR_OUT_OF_DATE_KHR) return std::nullopt;
    fail(*device_, result);
}

bool Swapchain::present(uint32_t i, vk::Semaphore finished) const {
    const vk::PresentInfoKHR info(finished, *swapchain_, i);
    const VkResult result = vkQueuePresentKHR(device_->queue(), reinterpret_cast<const VkPresentInfoKHR*>(&info));
    if (result == VK_SUCCESS) return true;
    if (result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR) return false;
    fail(*device_, result);
}

}  // namespace lw
