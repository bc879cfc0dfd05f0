#include "app/walkthrough.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/adapt.h"
#include "app/controls.h"
#include "app/panels.h"
#include "base/error.h"
#include "file/map_file.h"
#include "image/exr.h"
#include "image/png.h"
#include "scene/camera.h"
#include "trace/emitter.h"

namespace lw {
namespace {

constexpr double idle_seconds = 0.1;             // between frames when nothing changes
constexpr double sharpens_after_seconds = 0.25;  // a pause between two steps is still motion
constexpr double minimised_seconds = 0.2;

using SharedMap = std::shared_ptr<const PhotonMap>;

ReflectionView reflection_view_of(const Session& s, vk::Extent2D size) {
    const Camera camera = camera_of(s.walker, s.yfov, s.near);
    return {camera.position, camera.rotation, camera.yfov, uvec2(size.width, size.height),
            light_weights(s.world.scene, factors_now(s.lighting))};
}

/// Everything of one Vulkan device; made anew when the device is lost.
class Show {
  public:
    Show(Window& window, const WalkthroughSettings& settings, Session& session)
        : window_(window),
          session_(session),
          device_(with_window(settings.device)),
          presenter_(device_, window, settings.vsync),
          overlay_(window, device_, presenter_.swapchain()),
          reflections_(session.world.scene, session.world.caster) {
        std::fprintf(stderr, "%s on %s\n", session.world.scene.path.filename().c_str(), device_.name().c_str());
    }

    const Device& device() const { return device_; }

    void set_map(const SharedMap& map) {
        device_.handle().waitIdle();
        stage_.reset();
        stage_ = std::make_unique<Stage>(device_, session_.world.scene, map, session_.world.bvh);
        measured_.clear();
    }

    /// Handles what has come in, moves on and shows a frame.
    void frame(const std::optional<ProgressBoard::State>& baking) {
        const bool idle = stage_ && stage_->is_finished(shot_of(session_, 1)) && !session_.flight;
        const Events events = window_.poll(window_.size().width == 0 ? minimised_seconds : idle ? idle_seconds : 0);
        const double now = Window::now();
        const auto seconds = float(idle ? std::min(now - last_, 0.05) : now - last_);
        last_ = now;
        take_input(events, seconds);
        const std::optional<OpenFrame> open = presenter_.begin();
        if (!open) return;
        show(*open, baking, now);
        session_.statistics.frame_ms += 0.1 * ((Window::now() - shown_) * 1000 - session_.statistics.frame_ms);
        shown_ = Window::now();
    }

  private:
    static DeviceSettings with_window(DeviceSettings settings) {
        settings.window_extensions = Window::vulkan_extensions();
        return settings;
    }

    void take_input(const Events& events, float seconds) {
        const Taken taken{overlay_.wants_mouse() && !window_.is_captured(), overlay_.wants_keyboard()};
        apply_keys(session_, window_, events, taken, ImGui::GetIO().MouseWheel);
        apply_clicks(session_, window_, events, taken, stage_ ? &stage_->map() : nullptr);
        apply_gamepad(session_);
        advance(session_, walk_input(window_, events, taken, seconds), seconds);
        measure();
        seconds_ = seconds;
    }

    /// Measures again when the view, the lamps or the map have changed.
    void measure() {
        if (!stage_) return;
        const Camera camera = camera_of(session_.walker, session_.yfov, session_.near);
        const std::vector<vec3> factors = factors_now(session_.lighting);
        const bool lamps_changed = factors != measured_;
        const bool view_changed = camera.position != measured_eye_ || camera.rotation != measured_rotation_;
        if (!lamps_changed && !view_changed && session_.metering.on == session_.metering.live.has_value()) return;
        measure_again(session_, stage_->map(), lamps_changed);
        measured_ = factors;
        measured_eye_ = camera.position;
        measured_rotation_ = camera.rotation;
    }

    void draw_panels(const std::optional<ProgressBoard::State>& baking, double now) {
        overlay_.begin(!window_.is_captured());
        if (stage_) {
            draw_legend(session_);
            draw_split(session_);
            if (session_.panels) draw_lamp_marks(session_);
            draw_probe(session_);
            if (session_.viewing.reflections)
                draw_reflections(session_, reflections_.report(reflection_view_of(session_, window_.size()), now));
        }
        if (session_.panels) draw_lamp_panel(session_), draw_view_panel(session_);
        if (session_.keys) draw_keys();
        draw_notice(session_, baking, now);
    }

    void show(OpenFrame open, const std::optional<ProgressBoard::State>& baking, double now) {
        if (generation_ != presenter_.generation()) overlay_.attach(presenter_.swapchain());
        generation_ = presenter_.generation();
        if (stage_) follow_picture(open.slot);
        draw_panels(baking, now);
        const Buffer* picture = nullptr;
        if (stage_) {
            record_stage(open);
            picture = &stage_->screen();
        }
        const bool keep = session_.screenshot;
        const auto draw_over = [&](vk::CommandBuffer commands) { overlay_.record(commands, open.image); };
        presenter_.end(open, picture, draw_over, keep);
        if (keep) save_screenshot();
    }

    /// What the frame before the last tells: times, exposure, range.
    void follow_picture(uint slot) {
        stage_->resize(presenter_.swapchain().size());
        session_.statistics.times = stage_->times(slot);
        session_.statistics.device_bytes = stage_->bytes();
        session_.statistics.samples = stage_->samples();
        adapt_to(session_.viewing, stage_->glance(slot, session_.viewing.view), seconds_);
    }

    void record_stage(OpenFrame& open) {
        const uint divisor = divisor_.next(session_.viewing.divisor, session_.statistics, stage_->samples() > 1);
        Shot shot = shot_of(session_, divisor);
        if (!stage_->shows(shot, session_.viewing.view)) changed_ = last_;
        shot.sharpens = last_ - changed_ > sharpens_after_seconds;
        stage_->record(open.commands, shot, look_of(session_, presenter_.swapchain().is_bgr()), open.slot,
                       [&](vk::CommandBuffer& commands) {
                           presenter_.flush(open);
                           commands = open.commands;
                       });
    }

    void save_screenshot() {
        session_.screenshot = false;
        try {
            const std::filesystem::path png = free_name(session_, "png"), exr = free_name(session_, "exr");
            write_png(png, presenter_.shown());
            if (stage_) write_exr(exr, stage_->read_values());
            tell(session_, "saved " + png.string() + (stage_ ? " and " + exr.filename().string() : ""));
        } catch (const Error& failure) {
            tell(session_, failure.what());
        }
    }

    Window& window_;
    Session& session_;
    Device device_;
    Presenter presenter_;
    Overlay overlay_;
    std::unique_ptr<Stage> stage_;
    uint32_t generation_ = 0;
    ReflectionSearch reflections_;
    double changed_ = 0;  // when the picture last began anew
    double last_ = Window::now(), shown_ = last_;
    float seconds_ = 0;
    Divisor divisor_;
    std::vector<vec3> measured_;
    vec3 measured_eye_{0};
    mat3 measured_rotation_{1};
};

void refuse_validation_messages(const Device& device) {
    const std::vector<std::string> messages = device.validation_messages();
    if (!messages.empty())
        throw Error("Vulkan validation: " + std::to_string(messages.size()) + " messages, first: " + messages[0]);
}

/// Takes a finished map, and tells what went wrong.
void follow_baking(Baking& baking, Session& session, SharedMap& map, Show& show) {
    if (std::optional<PhotonMap> ready = baking.take()) {
        map = std::make_shared<const PhotonMap>(std::move(*ready));
        show.set_map(map);
        tell(session, std::to_string(map->stored_photons) + " photons", 3);
    }
    const std::string message = baking.take_message();
    if (!message.empty()) tell(session, message, 10);
}

/// Runs on one device until the window closes.
void run(Window& window, const WalkthroughSettings& settings, Session& session, SharedMap& map, Baking* baking) {
    Show show(window, settings, session);
    if (map) show.set_map(map);
    while (!window.closes()) {
        if (baking) follow_baking(*baking, session, map, show);
        show.frame(baking ? baking->progress() : std::nullopt);
    }
    refuse_validation_messages(show.device());
}

void set_start(const WalkthroughSettings& settings, Session& session) {
    const Camera& camera = find_camera(session.world.scene, settings.camera);
    session.walker = walker_at(camera, session.body, session.world.around);
    session.yfov = camera.yfov;
    if (settings.ambiance.empty()) return;
    chosen_factors(session.world.scene, settings.ambiance, {});  // refuses unknown ones
    std::vector<std::string> missing;
    session.lighting.board =
        with_ambiance(session.world.scene, session.lighting.book.ambiances.at(settings.ambiance), missing);
    session.lighting.current = settings.ambiance;
}

}  // namespace

void walk_in_window(const WalkthroughSettings& settings) {
    const World world(settings.scene);
    Session session(world, settings.output);
    set_start(settings, session);
    std::string reason;
    SharedMap map = try_load_map(settings.map, world.scene, reason);
    Window window("Lumenwalk - " + settings.scene.filename().string(), settings.size);
    std::unique_ptr<Baking> baking;
    if (!map) {
        tell(session, reason.empty() ? "no map beside the scene yet: baking one" : reason + ": baking a new one", 8);
        baking = std::make_unique<Baking>(world.scene, world.caster,
                                          Baking::Settings{100'000, settings.photons, settings.map});
    }
    double lost = -1e9;
    while (!window.closes()) {
        try {
            run(window, settings, session, map, baking.get());
        } catch (const vk::DeviceLostError&) {
            if (Window::now() - lost < 60) throw Error("Vulkan: the device was lost twice within a minute");
            lost = Window::now();
            tell(session, "the graphics device was lost: starting it again", 8);
        } catch (const vk::SystemError& failure) {
            throw Error(std::string("Vulkan: ") + failure.what());
        }
    }
}

}  // namespace lw
