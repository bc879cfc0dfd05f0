#include "app/show.h"

#include <algorithm>
#include <cstdio>

#include "app/clipboard.h"
#include "app/controls.h"
#include "app/metering.h"
#include "app/panels.h"
#include "base/error.h"
#include "image/exr.h"
#include "image/light_check.h"
#include "image/png.h"
#include "trace/emitter.h"

namespace lw {
namespace {

constexpr double idle_seconds = 0.1;             // between frames when nothing changes
constexpr double sharpens_after_seconds = 0.25;  // a pause between two steps is still motion
constexpr double minimised_seconds = 0.2;

DeviceSettings with_window(DeviceSettings settings) {
    settings.window_extensions = Window::vulkan_extensions();
    return settings;
}

ReflectionView reflection_view_of(const Session& s, vk::Extent2D size) {
    const Camera camera = camera_of(s.walker, s.yfov, s.near);
    return {camera.position, camera.rotation, camera.yfov, uvec2(size.width, size.height),
            light_weights(s.world.scene, factors_now(s.lighting))};
}

}  // namespace

Show::Show(Window& window, Session& session, const DeviceSettings& device, bool vsync)
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

void Show::set_map(const SharedMap& map) {
    device_.handle().waitIdle();
    stage_.reset();
    stage_ = std::make_unique<Stage>(device_, session_.world.scene, map, session_.world.bvh);
    session_.statistics.photons = map->stored_photons;
    measured_.clear();
}

void Show::frame(const BakingState& baking) {
    const bool idle = stage_ && stage_->is_finished(shot_of(session_, 1)) && !session_.flight;
    const Events events = window_.poll(window_.size().width == 0 ? minimised_seconds : idle ? idle_seconds : 0);
    const double now = Window::now();
    seconds_ = float(now - last_);
    const float seconds = idle ? std::min(seconds_, 0.05f) : seconds_;  // a step after a rest is no leap
    last_ = now;
    const std::optional<OpenFrame> open = presenter_.begin();
    if (open) begin_panels();  // before input is taken: they tell what is theirs of it
    take_input(events, seconds);
    if (!open) return;
    present(*open, baking, now);
    session_.statistics.frame_ms += 0.1 * ((Window::now() - shown_) * 1000 - session_.statistics.frame_ms);
    shown_ = Window::now();
}

void Show::take_input(const Events& events, float seconds) {
    const Taken taken{overlay_.wants_mouse() && !window_.is_captured(), overlay_.wants_keyboard()};
    apply_actions(session_, window_, events, taken, stage_ ? &stage_->map() : nullptr);
    apply_buttons(session_, events.buttons);
    advance(session_, walk_input(window_, events, taken, seconds), seconds);
    measure();
}

/// Measures again when the view, the lamps or the map have changed.
void Show::measure() {
    if (!stage_) return;
    const Camera camera = camera_of(session_.walker, session_.yfov, session_.near);
    const std::vector<vec3> factors = factors_now(session_.lighting);
    const bool lamps_changed = factors != measured_;
    const bool view_changed = camera.position != measured_eye_ || camera.rotation != measured_rotation_;
    if (!lamps_changed && !view_changed && session_.metering.on == session_.metering.live.has_value()) return;
    measure_again(session_, stage_->map(), lamps_changed);
    if (lamps_changed) value_fields(session_.fields, factors);
    measured_ = factors;
    measured_eye_ = camera.position;
    measured_rotation_ = camera.rotation;
}

void Show::begin_panels() {
    if (generation_ != presenter_.generation()) overlay_.attach(presenter_.swapchain());
    generation_ = presenter_.generation();
    overlay_.begin(!window_.is_captured());
}

void Show::draw_panels(const BakingState& baking, double now) {
    if (stage_) {
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
    draw_notice(session_, baking, now);
}

void Show::present(const OpenFrame& open, const BakingState& baking, double now) {
    if (stage_) follow_picture(open.slot);
    draw_panels(baking, now);
    if (stage_) record_stage(open);
    const Wish wish = session_.picture_wish;
    presenter_.end(
        open, stage_ ? &stage_->screen() : nullptr,
        [&](vk::CommandBuffer commands) { overlay_.record(commands, open.image); }, wish != Wish::none);
    if (wish != Wish::none) keep_screenshot();
}

/// What the frame before the last tells: times, exposure, range.
void Show::follow_picture(uint slot) {
    stage_->resize(presenter_.swapchain().size());
    session_.statistics.times = stage_->times(slot);
    session_.statistics.device_bytes = stage_->bytes();
    session_.statistics.samples = stage_->samples();
    adapt_to(session_.viewing, stage_->glance(slot, session_.viewing.view), seconds_);
}

void Show::record_stage(const OpenFrame& open) {
    const uint divisor = divisor_.next(session_.viewing.divisor, session_.statistics.times, stage_->samples() > 1);
    Shot shot = shot_of(session_, divisor);
    if (!stage_->shows(shot, session_.viewing.view)) changed_ = last_;
    shot.sharpens = last_ - changed_ > sharpens_after_seconds;
    shot.most_ms = wanted_frame_ms;
    estimate_error(shot, open.slot);
    stage_->record(open.commands, shot, look_of(session_, presenter_.swapchain().is_bgr()), open.slot);
}

/// Once for each picture that stands still.
void Show::estimate_error(const Shot& shot, uint slot) {
    std::optional<vec2>& error = session_.statistics.error;
    if (!stage_->is_finished(shot))
        error.reset();
    else if (session_.viewing.wants_error && !error && !session_.comparison.on)
        error = spread_of(stage_->inspect(shot, view_error, slot));
}

void Show::keep_screenshot() {
    const Wish wish = session_.picture_wish;
    session_.picture_wish = Wish::none;
    try {
        if (wish == Wish::copy) {
            copy_to_clipboard(presenter_.shown());
            return tell(session_, "picture copied to the clipboard");
        }
        const std::filesystem::path png = free_name(session_, "png"), exr = free_name(session_, "exr");
        const std::optional<Image> light = stage_ ? std::optional(stage_->read_values()) : std::nullopt;
        if (light) check_is_light(*light);
        write_png(png, presenter_.shown());
        if (light) write_exr(exr, *light);
        tell(session_, "saved " + png.string() + (stage_ ? " and " + exr.filename().string() : ""));
    } catch (const Error& failure) {
        tell(session_, failure.what());
    }
}

}  // namespace lw
