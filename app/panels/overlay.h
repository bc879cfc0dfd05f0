// Dear ImGui over the window's image: its context, style and Vulkan backend. The panels decide what is drawn.
#pragma once
#include "app/window/presenter.h"

namespace lw {

class Overlay {
  public:
    /// Window and device must outlive it; keys and clicks reach the window's own callbacks too.
    Overlay(const Window& window, const Device& device, const Swapchain& swapchain);
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    /// Must be called after the window's images have changed.
    void attach(const Swapchain& swapchain);
    /// Starts a frame of ImGui. With `mouse` = false ImGui ignores the mouse.
    void begin(bool mouse) const;
    /// Records what was drawn since begin() over image `image` in layout eColorAttachmentOptimal.
    void record(vk::CommandBuffer commands, uint32_t image) const;
    bool wants_mouse() const;
    bool wants_keyboard() const;  // true while a text field is edited

  private:
    void make_render_pass(vk::Format format);

    const Device* device_;
    vk::Extent2D size_;
    vk::UniqueDescriptorPool pool_;
    vk::UniqueRenderPass render_pass_;
    std::vector<vk::UniqueFramebuffer> framebuffers_;
};

}  // namespace lw
