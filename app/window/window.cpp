#include "app/window/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "base/error.h"

namespace lw {
namespace {

std::string last_glfw_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "unknown";
}

Window& window_of(GLFWwindow* handle) { return *static_cast<Window*>(glfwGetWindowUserPointer(handle)); }

std::optional<Gamepad> first_gamepad() {
    GLFWgamepadstate state;
    for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id) {
        if (!glfwJoystickIsGamepad(id) || !glfwGetGamepadState(id, &state)) continue;
        Gamepad pad;
        std::copy_n(state.axes, pad.axes.size(), pad.axes.begin());
        std::transform(state.buttons, state.buttons + pad.buttons.size(), pad.buttons.begin(),
                       [](unsigned char button) { return button == GLFW_PRESS; });
        return pad;
    }
    return std::nullopt;
}

/// Xlib calls this when the display has gone away. Its own text has one line or two, by the reason.
int end_without_display(void*) {
    std::fputs("lumenwalk: the display has gone away\n", stderr);
    std::exit(1);
}

/// GLFW loads libX11 when it needs it, so the handler is set by its name.
void set_display_handler() {
    using Handler = int (*)(void*);
    void* const x11 = dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
    const auto set = x11 ? reinterpret_cast<Handler (*)(Handler)>(dlsym(x11, "XSetIOErrorHandler")) : nullptr;
    if (set) set(end_without_display);
}

/// Initialises GLFW for the first window; the last one ends it.
void start_glfw() {
    glfwInitHint(GLFW_JOYSTICK_HAT_BUTTONS, GLFW_FALSE);
    if (!glfwInit()) throw Error("no display: " + last_glfw_error() + " (--play replays a path without one)");
    set_display_handler();
}

}  // namespace

std::vector<int> newly_pressed(const Gamepad& now, const Gamepad& before) {
    std::vector<int> pressed;
    for (size_t i = 0; i < now.buttons.size(); ++i)
        if (now.buttons[i] && !before.buttons[i]) pressed.push_back(int(i));
    return pressed;
}

Click click_at(double x, double y, vk::Extent2D units, vk::Extent2D pixels, bool right) {
    return {float(x * pixels.width / std::max(units.width, 1u)), float(y * pixels.height / std::max(units.height, 1u)),
            right};
}

Window::Window(const std::string& title, vk::Extent2D size) {
    start_glfw();
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    if (glfwVulkanSupported())
        window_ = glfwCreateWindow(int(size.width), int(size.height), title.c_str(), nullptr, nullptr);
    if (!window_) {
        const std::string reason = last_glfw_error();
        glfwTerminate();
        throw Error("no window: " + reason);
    }
    glfwSetWindowUserPointer(window_, this);
    static const auto on_key = [](GLFWwindow* w, int key, int, int action, int mods) {
        if (action == GLFW_PRESS)
            window_of(w).events_.actions.emplace_back(
                KeyPress{key, (mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0});
    };
    static const auto on_button = [](GLFWwindow* w, int button, int action, int) {
        if (action != GLFW_PRESS || button > GLFW_MOUSE_BUTTON_RIGHT) return;
        Window& window = window_of(w);
        int width = 0, height = 0;
        glfwGetWindowSize(w, &width, &height);
        window.events_.actions.emplace_back(click_at(window.pointer_x_, window.pointer_y_,
                                                     {uint32_t(width), uint32_t(height)}, window.size(),
                                                     button == GLFW_MOUSE_BUTTON_RIGHT));
    };
    static const auto on_move = [](GLFWwindow* w, double x, double y) {
        window_of(w).pointer_x_ = x, window_of(w).pointer_y_ = y;
    };
    glfwSetKeyCallback(
        window_, [](GLFWwindow* w, int key, int code, int action, int mods) { on_key(w, key, code, action, mods); });
    glfwSetScrollCallback(
        window_, [](GLFWwindow* w, double, double y) { window_of(w).events_.actions.emplace_back(Scroll{float(y)}); });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) { on_move(w, x, y); });
    glfwSetMouseButtonCallback(
        window_, [](GLFWwindow* w, int button, int action, int mods) { on_button(w, button, action, mods); });
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

std::vector<std::string> Window::vulkan_extensions() {
    uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (!names) throw Error("no window: Vulkan cannot show pictures on this display");
    return {names, names + count};
}

vk::UniqueSurfaceKHR Window::make_surface(const Device& device) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (glfwCreateWindowSurface(device.instance(), window_, nullptr, &surface) != VK_SUCCESS)
        throw Error("no window: " + last_glfw_error());
    return vk::UniqueSurfaceKHR(surface, device.instance());
}

Events Window::poll(double wait_seconds) {
    if (wait_seconds > 0)
        glfwWaitEventsTimeout(wait_seconds);
    else
        glfwPollEvents();
    Events events;
    std::swap(events, events_);
    events.size = size();
    events.gamepad = first_gamepad();
    const Gamepad pad = events.gamepad.value_or(Gamepad{});
    events.buttons = newly_pressed(pad, gamepad_);
    gamepad_ = pad;
    double x = 0, y = 0;
    glfwGetCursorPos(window_, &x, &y);
    if (captured_ && has_last_) events.mouse_x = float(x - last_x_), events.mouse_y = float(y - last_y_);
    last_x_ = x, last_y_ = y, has_last_ = captured_;
    return events;
}

bool Window::closes() const { return glfwWindowShouldClose(window_) != 0; }

void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }

bool Window::is_down(int key) const { return glfwGetKey(window_, key) == GLFW_PRESS; }

void Window::capture_mouse(bool captured) {
    if (captured == captured_) return;
    captured_ = captured;
    has_last_ = false;
    glfwSetInputMode(window_, GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    if (glfwRawMouseMotionSupported()) glfwSetInputMode(window_, GLFW_RAW_MOUSE_MOTION, captured);
}

void Window::toggle_full_screen() {
    if (glfwGetWindowMonitor(window_)) {
        glfwSetWindowMonitor(window_, nullptr, windowed_[0], windowed_[1], windowed_[2], windowed_[3], 0);
        return;
    }
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (!mode) return;
    glfwGetWindowPos(window_, &windowed_[0], &windowed_[1]);
    glfwGetWindowSize(window_, &windowed_[2], &windowed_[3]);
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

vk::Extent2D Window::size() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) width = height = 0;
    return {uint32_t(width), uint32_t(height)};
}

float Window::scale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return std::max(x, 0.5f);
}

double Window::now() { return glfwGetTime(); }

}  // namespace lw
