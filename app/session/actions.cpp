#include "app/session/actions.h"

#include <cstdio>

namespace lw {
namespace {

constexpr double recorded_per_second = 10;

void record(Session& session, float seconds) {
    if (!session.recording) return;
    Path& path = *session.recording;
    session.recorded_seconds += double(seconds);
    if (!path.keys.empty() && session.recorded_seconds < path.keys.back().time + 1 / recorded_per_second) return;
    const Bookmark b = bookmark_of("", session.walker, session.yfov, session.world.scene);
    path.keys.push_back({session.recorded_seconds, b.position, double(b.yaw_deg), double(b.pitch_deg)});
}

}  // namespace

void tell(Session& session, const std::string& text, double seconds) {
    std::fprintf(stderr, "%s\n", text.c_str());
    using std::chrono::steady_clock;
    const auto shown = std::chrono::duration_cast<steady_clock::duration>(std::chrono::duration<double>(seconds));
    session.notice = {text, steady_clock::now() + shown};
}

void fade_to(Lighting& lighting, const LampStates& lamps) {
    const std::vector<vec3> from = factors_now(lighting);
    lighting.lamps = lamps;
    lighting.fade.reset();
    if (lighting.fade_seconds > 0) lighting.fade = Fade{from, lighting.fade_seconds, 0};
}

bool fly_to(Session& s, size_t index) {
    const std::vector<Camera>& cameras = s.world.scene.cameras;
    if (index >= cameras.size() + s.bookmarks.size()) return false;
    const Camera camera = index < cameras.size()
                              ? cameras[index]
                              : camera_of(s.bookmarks[index - cameras.size()], s.world.scene, s.yfov, s.near);
    const Walker to = walker_at(camera, s.body, s.world.collision);
    s.transition = ViewTransition{s.walker, to, s.yfov, camera.yfov};
    s.place = int(index);
    tell(s, camera.name, 2);
    return true;
}

void start_recording(Session& s) {
    s.recording = Path{30, double(s.yfov) * 180 / double(lw_pi), {}};
    s.recorded_seconds = 0;
    record(s, 0);
}

void advance(Session& s, const WalkInput& input, float seconds) {
    if (s.transition) {
        s.transition->passed += seconds;
        s.walker = walker_at(*s.transition);
        s.yfov = yfov_at(*s.transition);
        const bool interrupted = length(input.move) > 0 || length(input.turn) > 0;
        if (interrupted) s.walker = land(s.walker, s.body, s.world.collision);
        if (interrupted || s.transition->passed >= s.transition->seconds) s.transition.reset();
    } else {
        s.walker = walk(s.walker, input, seconds, s.body, s.world.collision);
    }
    if (std::optional<Fade>& fade = s.lighting.fade) {
        fade->passed += seconds;
        if (fade->passed >= fade->seconds) fade.reset();
    }
    record(s, seconds);
}

}  // namespace lw
