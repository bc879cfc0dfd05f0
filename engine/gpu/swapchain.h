// The images of a window's surface. Plain Vulkan, without knowledge of the window system. The images hold 8-bit sRGB
// codes, which are written as they are, by copies or draws.
#pragma once
#include <optional>

#include "gpu/device.h"

namespace lw {

class Swapchain {
  public:
    /// `wanted`: pixels, used when the surface leaves its size to the application. Waits for the display (FIFO) when
    /// `vsync`. Throws Error when the device cannot present to the surface. The surface must not have another living
    /// swapchain, its size must not be 0.
    Swapchain(const Device& device, vk::SurfaceKHR surface, vk::Extent2D wanted, bool vsync);

    vk::Extent2D size() const { return size_; }
    vk::Format format() const { return format_; }
    /// True when blue comes first in the images' bytes.
    bool is_bgr() const { return format_ == vk::Format::eB8G8R8A8Unorm; }
    uint32_t count() const { return uint32_t(images_.size()); }
    vk::Image image(uint32_t i) const { return images_[i]; }
    vk::ImageView view(uint32_t i) const { return *views_[i]; }

    /// The index of the next image, which may be written once `available` is signalled; nothing when the swapchain no
    /// longer fits its surface and must be made again.
    std::optional<uint32_t> acquire(vk::Semaphore available) const;
    /// Shows image i once `finished` is signalled. Returns false when the swapchain no longer fits its surface.
    bool present(uint32_t i, vk::Semaphore finished) const;

  private:
    const Device* device_;
    vk::Extent2D size_;
    vk::Format format_ = vk::Format::eUndefined;
    vk::UniqueSwapchainKHR swapchain_;
    std::vector<vk::Image> images_;
    std::vector<vk::UniqueImageView> views_;
};

/// The size of the surface in pixels; `wanted` when the surface leaves it to the application.
vk::Extent2D surface_size(const Device& device, vk::SurfaceKHR surface, vk::Extent2D wanted);

}  // namespace lw
