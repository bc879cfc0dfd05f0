// The window and what the user does in it, through GLFW. Knows keys and pixels, nothing of scenes.
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
    bool right = false;  // button
};

/// A key as it was pressed: by the time it is handled Shift and Ctrl may be up again.
struct KeyPress {
    int key;  // GLFW code
    bool shift, control;
};

/// A turn of the mouse wheel, away from the user positive.
struct Scroll {
    float turns;
};

/// A gamepad in the layout of GLFW: indices GLFW_GAMEPAD_AXIS_*, GLFW_GAMEPAD_BUTTON_*.
struct Gamepad {
    std::array<float, 6> axes{};  // -1 to 1, right and down are positive
    std::array<bool, 15> buttons{};
};

/// The buttons of `now` that were up in `before`.
std::vector<int> newly_pressed(const Gamepad& now, const Gamepad& before);

/// Where in a picture of `pixels` the pointer is, from its place in a window of `units`: on a fine screen a unit has
/// several pixels.
Click click_at(double x, double y, vk::Extent2D units, vk::Extent2D pixels, bool right);

/// What happened since the last poll.
struct Events {
    std::vector<std::variant<KeyPress, Click, Scroll>> actions;  // in their order: a frame may take long
    std::optional<Gamepad> gamepad;                              // the first there is
    std::vector<int> buttons;                                    // of the gamepad, newly pressed
    vk::Extent2D size;                                           // of the picture, pixels; 0 while minimised
    float mouse_x = 0, mouse_y = 0;                              // moved, in screen units; only while captured
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
    double pointer_x_ = 0, pointer_y_ = 0;  // by the last event: when a click is handled the pointer may be elsewhere
    double last_x_ = 0, last_y_ = 0;
    bool has_last_ = false;
    Gamepad gamepad_;                          // at the last poll
    int windowed_[4] = {100, 100, 1280, 720};  // place and size before full screen
};

}  // namespace lw
