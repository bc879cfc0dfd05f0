// Presents frames in the window. At most two are in flight, so that input shows in the next image or the one after. The
// picture of a frame is copied into the window's image, then the panels are drawn over it.
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

    /// Starts a frame: waits for the frame before the last, then for a free image. Makes a new swapchain when the
    /// window has changed. Returns nothing while the window has no size.
    std::optional<OpenFrame> begin();
    /// Submits the commands recorded so far and waits for them; afterwards frame.commands are new ones.
    void flush(OpenFrame& frame);
    /// Ends a frame: copies `picture` (4-byte pixels, in size and byte order of the swapchain; black when null) into
    /// the window's image, calls `draw_over` with the image in layout eColorAttachmentOptimal, and shows it. With
    /// `keep_shown` shown() can return the result.
    void end(const OpenFrame& frame, const Buffer* picture, const std::function<void(vk::CommandBuffer)>& draw_over,
             bool keep_shown = false);
    /// The image of the last frame with keep_shown; waits for the device.
    Rgb8Image shown() const;

  private:
    struct Slot {
        vk::UniqueCommandPool pool;
        std::vector<vk::UniqueCommandBuffer> commands;  // freed when the slot is used again
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
