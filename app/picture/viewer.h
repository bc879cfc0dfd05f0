// Everything of one Vulkan device: the window's images, the scene on the device, the panels over it. Made anew when the
// device is lost.
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
    /// Takes up a map; what was measured in the one before is measured again.
    void set_map(const SharedMap& map);
    /// Handles what has come in, moves on and shows a frame: what the user does is in the picture that is made next.
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
    uint32_t generation_ = 0;  // of the window's images that the overlay draws on
    double changed_ = 0;       // when the picture last began anew
    double last_, shown_;
    float seconds_ = 0;
    DynamicResolution resolution_;
    ReflectionSearch reflections_;
    std::vector<vec3> measured_;  // factors of the lamps, place and view of the last measurement
    vec3 measured_eye_{0};
    mat3 measured_rotation_{1};
};

}  // namespace lw
