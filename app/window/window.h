// The window and its input, through GLFW. Knows keys and pixels, nothing of scenes.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "gpu/device.h"

struct GLFWwindow;

namespace lw {

struct Click {
    float x = 0, y = 0;  // pixels of the picture from the top left corner
    bool right = false;  // the right button, not the left
};

/// A key press with the state of Shift and Ctrl at that moment.
struct KeyPress {
    int key;  // GLFW code
    bool shift, control;
};

/// A turn of the mouse wheel; positive away from the user.
struct Scroll {
    float turns;
};

/// A gamepad in the layout of GLFW: indices GLFW_GAMEPAD_AXIS_*, GLFW_GAMEPAD_BUTTON_*.
struct Gamepad {
    std::array<float, 6> axes{};  // -1 to 1, right and down are positive
    std::array<bool, 15> buttons{};
};

/// The buttons that are down in `now` and were up in `before`, as indices.
std::vector<int> newly_pressed(const Gamepad& now, const Gamepad& before);

/// The place of the pointer in pixels, from its place (x, y) in the units of the desktop. `units` and `pixels` are the
/// window's size in both; on a fine screen a unit has several pixels.
Click click_at(double x, double y, vk::Extent2D units, vk::Extent2D pixels, bool right);

/// The input since the last poll.
struct Events {
    std::vector<std::variant<KeyPress, Click, Scroll>> actions;  // in the order they came, as a frame may take long
    std::optional<Gamepad> gamepad;                              // state of the first gamepad, if any
    std::vector<int> buttons;                                    // of the gamepad, newly pressed
    vk::Extent2D size;                                           // of the picture, pixels; 0 while minimised
    float mouse_x = 0, mouse_y = 0;  // movement in units of the desktop; only while the mouse is captured
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

    /// Returns the input since the last call. Waits up to `wait_seconds` for an event; 0: does not wait.
    Events poll(double wait_seconds);
    bool closes() const;
    void close();
    bool is_down(int key) const;
    bool is_captured() const { return captured_; }
    /// true: hides the pointer and reports the movements of the mouse; false: shows it again.
    void capture_mouse(bool captured);
    void toggle_full_screen();
    vk::Extent2D size() const;
    /// Pixels per unit of the desktop: 1 on an ordinary screen, 2 on a fine one.
    float scale() const;
    /// Seconds since the program started.
    static double now();
    GLFWwindow* handle() const { return window_; }

  private:
    GLFWwindow* window_ = nullptr;
    Events events_;
    bool captured_ = false;
    double pointer_x_ = 0, pointer_y_ = 0;  // at the last event: the pointer may have moved when a click is handled
    double last_x_ = 0, last_y_ = 0;
    bool has_last_ = false;
    Gamepad gamepad_;                          // at the last poll
    int windowed_[4] = {100, 100, 1280, 720};  // place and size before full screen
};

}  // namespace lw
