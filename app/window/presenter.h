// Frames on their way to the window: at most two in flight, so that an input shows in the next image or the one after.
// Each frame's picture is copied into the window's image, then drawn over.
#pragma once
#include <array>
#include <functional>
#include <optional>

#include "app/window/window.h"
#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/swapchain.h"
#include "image/rgb8_image.h"

namespace lw {

/// A frame being recorded.
struct OpenFrame {
    vk::CommandBuffer commands;
    uint32_t slot;   // 0 or 1
    uint32_t image;  // of the swapchain
};

class Presenter {
  public:
    static constexpr uint32_t slots = 2;

    /// Device and window must outlive it; the window must not be minimised.
    Presenter(const Device& device, const Window& window, bool vsync);
    ~Presenter();

    const Swapchain& swapchain() const { return *swapchain_; }
    /// Counts the swapchains made so far.
    uint32_t generation() const { return generation_; }

    /// Waits for the slot of two frames ago, then for a free image; makes a new swapchain when the window has changed.
    /// None while the window has no size.
    std::optional<OpenFrame> begin();
    /// Sends off what is recorded so far and waits until the device has done it; the frame goes on with new commands.
    void flush(OpenFrame& frame);
    /// Copies `picture` (4-byte pixels of the swapchain's size and order), or black when it is null, into the window's
    /// image; `draw_over` draws over it in layout eColorAttachmentOptimal; then it is shown.
    void end(const OpenFrame& frame, const Buffer* picture, const std::function<void(vk::CommandBuffer)>& draw_over,
             bool keep_shown = false);
    /// What the last frame with keep_shown showed; waits for the device.
    Rgb8Image shown() const;

  private:
    struct Slot {
        vk::UniqueCommandPool pool;
        std::vector<vk::UniqueCommandBuffer> commands;  // freed when the slot comes round
        vk::UniqueFence done;
        vk::UniqueSemaphore available;
    };
    void make_swapchain();
    vk::CommandBuffer begin_commands(Slot& slot) const;
    void record_copy(const OpenFrame& frame, const Buffer* picture) const;
    void record_keep(const OpenFrame& frame);

    const Device* device_;
    const Window* window_;
    bool vsync_;
    vk::UniqueSurfaceKHR surface_;
    std::optional<Swapchain> swapchain_;
    std::vector<vk::UniqueSemaphore> finished_;  // per image
    std::array<Slot, slots> slots_;
    uint32_t next_slot_ = 0;
    uint32_t generation_ = 0;
    bool outdated_ = false;
    Buffer kept_;
};

}  // namespace lw
