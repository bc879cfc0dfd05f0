// The window and what the user does in it, through GLFW. Knows keys and pixels, nothing of scenes.
#pragma once
#include <string>
#include <vector>

#include "gpu/device.h"

struct GLFWwindow;

namespace lw {

struct Click {
    float x = 0, y = 0;  // pixels of the picture from the top left corner
    bool right = false;  // button
};

/// A key as it was pressed: by the time it is handled Shift and Ctrl may be up again.
struct KeyPress {
    int key;  // GLFW code
    bool shift, control;
};

/// What happened since the last poll.
struct Events {
    std::vector<KeyPress> keys;
    std::vector<Click> clicks;
    vk::Extent2D size;               // of the picture, pixels; 0 while minimised
    float mouse_x = 0, mouse_y = 0;  // moved, in screen units; only while captured
};

class Window {
  public:
    /// Throws Error when there is no display or no Vulkan for it.
    Window(const std::string& title, vk::Extent2D size);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Instance extensions a device needs to show pictures here.
    static std::vector<std::string> vulkan_extensions();
    vk::UniqueSurfaceKHR make_surface(const Device& device) const;

    /// Handles what has come in; waits up to `wait_seconds` for the first event (0: does not wait).
    Events poll(double wait_seconds);
    bool closes() const;
    void close();
    bool is_down(int key) const;
    bool is_captured() const { return captured_; }
    /// Hides the mouse pointer and reads its movements, or lets it go.
    void capture_mouse(bool captured);
    void toggle_full_screen();
    vk::Extent2D size() const;
    /// Pixels per unit of the desktop's design, 1 on an ordinary screen, 2 on a fine one.
    float scale() const;
    /// Seconds since the program started.
    static double now();
    GLFWwindow* handle() const { return window_; }

  private:
    GLFWwindow* window_ = nullptr;
    Events events_;
    bool captured_ = false;
    double last_x_ = 0, last_y_ = 0;
    bool has_last_ = false;
    int windowed_[4] = {100, 100, 1280, 720};  // place and size before full screen
};

}  // namespace lw
