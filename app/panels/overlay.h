// Dear ImGui over the window's image: its context, style and Vulkan backend. What is drawn is up to the panels.
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

    /// After the window's images have changed.
    void attach(const Swapchain& swapchain);
    /// Everything drawn with ImGui after this belongs to the frame. Without `mouse` it leaves the mouse alone.
    void begin(bool mouse) const;
    /// Records what was drawn since begin() over image `image` in layout eColorAttachmentOptimal.
    void record(vk::CommandBuffer commands, uint32_t image) const;
    bool wants_mouse() const;
    bool wants_keyboard() const;  // a text field is being edited

  private:
    void make_render_pass(vk::Format format);

    const Device* device_;
    vk::Extent2D size_;
    vk::UniqueDescriptorPool pool_;
    vk::UniqueRenderPass render_pass_;
    std::vector<vk::UniqueFramebuffer> framebuffers_;
};

}  // namespace lw
