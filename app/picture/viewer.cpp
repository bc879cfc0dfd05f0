#include "app/picture/viewer.h"

#include <algorithm>
#include <cstdio>

#include "app/controls.h"
#include "app/measuring/metering.h"
#include "app/panels/panels.h"
#include "app/session/actions.h"
#include "app/session/saving.h"
#include "app/window/clipboard.h"
#include "base/error.h"
#include "image/exr.h"
#include "image/light_check.h"
#include "image/png.h"
#include "trace/emitter.h"

namespace lw {
namespace {

constexpr double idle_seconds = 0.1;             // wait between frames when nothing changes
constexpr double sharpens_after_seconds = 0.25;  // a shorter pause between two steps still counts as motion
constexpr double minimised_seconds = 0.2;

DeviceSettings with_window(DeviceSettings settings) {
    settings.window_extensions = Window::vulkan_extensions();
    return settings;
}

ReflectionView reflection_view_of(const Session& s, vk::Extent2D size) {
    const Camera camera = camera_of(s.walker, s.yfov, s.near);
    return {camera.position, camera.rotation, camera.yfov, uvec2(size.width, size.height),
            lamp_powers(s.world.scene, factors_now(s.lighting))};
}

}  // namespace

Viewer::Viewer(Window& window, Session& session, const DeviceSettings& device, bool vsync)
    : window_(window),
      session_(session),
      device_(with_window(device)),
      presenter_(device_, window, vsync),
      overlay_(window, device_, presenter_.swapchain()),
      last_(Window::now()),
      shown_(last_),
      reflections_(session.world.scene, session.world.caster) {
    std::fprintf(stderr, "%s on %s\n", session.world.scene.path.filename().c_str(), device_.name().c_str());
}

void Viewer::set_map(const SharedMap& map) {
    device_.handle().waitIdle();
    probe_.reset();
    renderer_.reset();
    renderer_ = std::make_unique<ProgressiveRenderer>(device_, session_.world.scene, map, session_.world.bvh);
    probe_ = std::make_unique<Probe>(session_.world.scene, session_.world.caster, *map, session_.world.bvh);
    session_.statistics.photons = map->stored_photons;
    measured_.clear();
}

void Viewer::frame(const BakingState& baking) {
    const bool idle = renderer_ && renderer_->is_finished(frame_request_of(session_, 1)) && !session_.transition;
    const Events events = window_.poll(window_.size().width == 0 ? minimised_seconds : idle ? idle_seconds : 0);
    const double now = Window::now();
    seconds_ = float(now - last_);
    const float seconds = idle ? std::min(seconds_, 0.05f) : seconds_;  // no leap after a rest
    last_ = now;
    const std::optional<OpenFrame> open = presenter_.begin();
    if (open) begin_panels();  // before input is taken: the panels say which of it they use
    take_input(events, seconds);
    if (!open) return;
    present(*open, baking, now);
    session_.statistics.frame_ms += 0.1 * ((Window::now() - shown_) * 1000 - session_.statistics.frame_ms);
    shown_ = Window::now();
}

void Viewer::take_input(const Events& events, float seconds) {
    const PanelCapture capture{overlay_.wants_mouse() && !window_.is_captured(), overlay_.wants_keyboard()};
    apply_actions(session_, window_, events, capture, probe_.get());
    apply_buttons(session_, events.buttons);
    advance(session_, walk_input(window_, events, capture, seconds), seconds);
    measure();
}

/// Measures probe and pins again when the view, the lamps or the map have changed.
void Viewer::measure() {
    if (!renderer_) return;
    const Camera camera = camera_of(session_.walker, session_.yfov, session_.near);
    const std::vector<vec3> factors = factors_now(session_.lighting);
    const bool lamps_changed = factors != measured_;
    const bool view_changed = camera.position != measured_eye_ || camera.rotation != measured_rotation_;
    if (!lamps_changed && !view_changed && session_.metering.on == session_.metering.live.has_value()) return;
    measure_again(session_, *probe_, lamps_changed);
    if (lamps_changed) value_fields(session_.fields, factors);
    measured_ = factors;
    measured_eye_ = camera.position;
    measured_rotation_ = camera.rotation;
}

void Viewer::begin_panels() {
    if (generation_ != presenter_.generation()) overlay_.attach(presenter_.swapchain());
    generation_ = presenter_.generation();
    overlay_.begin(!window_.is_captured());
}

void Viewer::draw_panels(const BakingState& baking, double now) {
    if (renderer_) {
        draw_legend(session_);
        draw_split(session_);
        if (session_.panels) draw_lamp_marks(session_);
        draw_fields(session_);
        draw_probe(session_);
        if (session_.viewing.reflections)
            draw_reflections(session_, reflections_.report(reflection_view_of(session_, window_.size()), now));
    }
    if (session_.panels) draw_lamp_panel(session_), draw_view_panel(session_);
    if (session_.keys) draw_keys();
    draw_notice(session_, baking);
}

void Viewer::present(const OpenFrame& open, const BakingState& baking, double now) {
    if (renderer_) follow_picture(open.slot);
    draw_panels(baking, now);
    if (renderer_) record_frame(open);
    const PictureRequest request = session_.picture_request;
    presenter_.end(
        open, renderer_ ? &renderer_->screen() : nullptr,
        [&](vk::CommandBuffer commands) { overlay_.record(commands, open.image); }, request != PictureRequest::none);
    if (request != PictureRequest::none) keep_screenshot();
}

/// Takes times, exposure and range of false colours from the last finished frame of this slot.
void Viewer::follow_picture(uint slot) {
    renderer_->resize(presenter_.swapchain().size());
    session_.statistics.times = renderer_->times(slot);
    session_.statistics.device_bytes = renderer_->bytes();
    session_.statistics.samples = renderer_->samples();
    adapt_to(session_.viewing, renderer_->readback(slot, session_.viewing.view), seconds_);
}

void Viewer::record_frame(const OpenFrame& open) {
    const uint divisor =
        resolution_.next(session_.viewing.divisor, session_.statistics.times, renderer_->samples() > 1);
    FrameRequest request = frame_request_of(session_, divisor);
    if (!renderer_->shows(request, session_.viewing.view)) changed_ = last_;
    request.sharpens = last_ - changed_ > sharpens_after_seconds;
    request.max_ms = wanted_frame_ms;
    estimate_error(request, open.slot);
    renderer_->record(open.commands, request, display_settings_of(session_, presenter_.swapchain().is_bgr()),
                      open.slot);
}

/// Estimates the error of a still picture, once for each.
void Viewer::estimate_error(const FrameRequest& request, uint slot) {
    std::optional<vec2>& error = session_.statistics.error;
    if (!renderer_->is_finished(request))
        error.reset();
    else if (session_.viewing.wants_error && !error && !session_.comparison.on)
        error = spread_of(renderer_->inspect(request, view_error, slot));
}

void Viewer::keep_screenshot() {
    const PictureRequest request = session_.picture_request;
    session_.picture_request = PictureRequest::none;
    try {
        if (request == PictureRequest::copy) {
            copy_to_clipboard(presenter_.shown());
            return tell(session_, "picture copied to the clipboard");
        }
        const std::filesystem::path png = free_name(session_, "png"), exr = free_name(session_, "exr");
        const std::optional<Image> light = renderer_ ? std::optional(renderer_->read_values()) : std::nullopt;
        if (light) check_is_light(*light);
        write_png(png, presenter_.shown());
        if (light) write_exr(exr, *light);
        tell(session_, "saved " + png.string() + (renderer_ ? " and " + exr.filename().string() : ""));
    } catch (const Error& failure) {
        tell(session_, failure.what());
    }
}

}  // namespace lw
