// All that lives on one Vulkan device: the window's images, the scene with its map, the panels. A new one is made when
// the device is lost.
#pragma once
#include <memory>

#include "app/measuring/reflection_search.h"
#include "app/panels/overlay.h"
#include "app/picture/exposure.h"
#include "app/session/session.h"
#include "app/window/window.h"
#include "base/progress.h"

namespace lw {

using SharedMap = std::shared_ptr<const PhotonMap>;
using BakingState = std::optional<ProgressBoard::State>;

class Viewer {
  public:
    /// Window and session must outlive it. Throws Error when there is no device for the window.
    Viewer(Window& window, Session& session, const DeviceSettings& device, bool vsync);

    const Device& device() const { return device_; }
    /// Shows this map from now on, and measures again what was measured in the one before.
    void set_map(const SharedMap& map);
    /// Handles input, moves the walker and shows a frame. Input that has come before is in this frame. `baking`:
    /// progress of a running bake, for the notice.
    void frame(const BakingState& baking);

  private:
    void take_input(const Events& events, float seconds);
    void measure();
    void begin_panels();
    void draw_panels(const BakingState& baking, double now);
    void present(const OpenFrame& open, const BakingState& baking, double now);
    void follow_picture(uint slot);
    void record_frame(const OpenFrame& open);
    void estimate_error(const FrameRequest& request, uint slot);
    void keep_screenshot();

    Window& window_;
    Session& session_;
    Device device_;
    Presenter presenter_;
    Overlay overlay_;
    std::unique_ptr<ProgressiveRenderer> renderer_;
    std::unique_ptr<const Probe> probe_;  // of the renderer's map
    uint32_t generation_ = 0;             // Presenter::generation() of the images that the overlay draws on
    double changed_ = 0;                  // time at which the picture last started anew, s
    double last_, shown_;
    float seconds_ = 0;
    DynamicResolution resolution_;
    ReflectionSearch reflections_;
    std::vector<vec3> measured_;  // factors of the lamps, eye and rotation at the last measurement
    vec3 measured_eye_{0};
    mat3 measured_rotation_{1};
};

}  // namespace lw
