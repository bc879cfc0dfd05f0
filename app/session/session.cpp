#include "app/session/session.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/window/window.h"
#include "base/error.h"
#include "photometry/photometry.h"

namespace lw {
namespace {

constexpr double recorded_per_second = 10;

/// Calls `load`. An error is shown to the user and kept in `trouble`, so that the file is not overwritten later.
template <class Value, class Load>
Value loaded_or_empty(const Load& load, std::string& trouble) {
    try {
        return load();
    } catch (const Error& failure) {
        trouble = failure.what();
        std::fprintf(stderr, "warning: %s\n", trouble.c_str());
        return {};
    }
}

void record(Session& session, float seconds) {
    if (!session.recording) return;
    Path& path = *session.recording;
    session.recorded_seconds += double(seconds);
    if (!path.keys.empty() && session.recorded_seconds < path.keys.back().time + 1 / recorded_per_second) return;
    const Bookmark b = bookmark_of("", session.walker, session.yfov, session.world.scene);
    path.keys.push_back({session.recorded_seconds, b.position, double(b.yaw_deg), double(b.pitch_deg)});
}

}  // namespace

Session::Session(const World& w, std::filesystem::path folder)
    : world(w),
      output(std::move(folder)),
      body(body_for(w.scene)),
      walker(walker_at(w.scene.cameras[0], body, w.around)),
      yfov(w.scene.cameras[0].yfov),
      near(w.scene.cameras[0].near) {
    lighting.board.resize(w.scene.lights.size());
    comparison.board = lighting.board;
    lighting.book = loaded_or_empty<LampBook>([&] { return load_lamp_book(default_ambiances_path(w.scene.path)); },
                                              lighting.book_trouble);
    bookmarks = loaded_or_empty<std::vector<Bookmark>>(
        [&] { return load_bookmarks(default_bookmarks_path(w.scene.path)); }, bookmarks_trouble);
}

Session::Session(const World& w, const Session& before) : Session(w, before.output) {
    body = before.body;
    walker = before.walker;
    yfov = before.yfov;
    recording = before.recording;
    recorded_seconds = before.recorded_seconds;
    lighting = before.lighting;
    comparison = before.comparison;
    viewing = before.viewing;
    metering = before.metering;
    fields = before.fields;
    panels = before.panels;
    notice = before.notice;
}

void tell(Session& session, const std::string& text, double seconds) {
    std::fprintf(stderr, "%s\n", text.c_str());
    session.notice = {text, Window::now() + seconds};
}

std::vector<vec3> factors_now(const Lighting& lighting) {
    const std::vector<vec3> target = factors_of(lighting.board);
    if (!lighting.fade) return target;
    return mixed(lighting.fade->from, target, lighting.fade->passed / lighting.fade->seconds);
}

void fade_to(Lighting& lighting, const LampBoard& board) {
    const std::vector<vec3> from = factors_now(lighting);
    lighting.board = board;
    lighting.fade.reset();
    if (lighting.fade_seconds > 0) lighting.fade = Fade{from, lighting.fade_seconds, 0};
}

void save_book(Session& s, const std::string& what) {
    const std::filesystem::path path = default_ambiances_path(s.world.scene.path);
    if (!s.lighting.book_trouble.empty()) {
        tell(s, s.lighting.book_trouble + "; put it right or move it away");
        return;
    }
    try {
        save_lamp_book(path, s.lighting.book);
        tell(s, what + " saved in " + path.string());
    } catch (const Error& failure) {
        tell(s, failure.what());
    }
}

void attach_file(Session& s, size_t lamp, const std::string& file) {
    const std::string& name = s.world.scene.light_names[lamp];
    try {
        if (!file.empty()) read_photometry(s.world.scene.path.parent_path() / file);
    } catch (const Error& failure) {
        return tell(s, failure.what(), 8);
    }
    if (file.empty())
        s.lighting.book.photometry.erase(name);
    else
        s.lighting.book.photometry[name] = file;
    save_book(s, "light distribution of \"" + name + "\"");
    s.reload = true;
}

bool fly_to(Session& s, size_t index) {
    const std::vector<Camera>& cameras = s.world.scene.cameras;
    if (index >= cameras.size() + s.bookmarks.size()) return false;
    const Camera camera = index < cameras.size()
                              ? cameras[index]
                              : camera_of(s.bookmarks[index - cameras.size()], s.world.scene, s.yfov, s.near);
    const Walker to = walker_at(camera, s.body, s.world.around);
    s.transition = ViewTransition{s.walker, to, s.yfov, camera.yfov};
    s.place = int(index);
    tell(s, camera.name, 2);
    return true;
}

void add_bookmark(Session& s) {
    if (!s.bookmarks_trouble.empty()) {
        tell(s, s.bookmarks_trouble + "; put it right or move it away");
        return;
    }
    const std::string name = "bookmark " + std::to_string(s.bookmarks.size() + 1);
    s.bookmarks.push_back(bookmark_of(name, s.walker, s.yfov, s.world.scene));
    const std::filesystem::path path = default_bookmarks_path(s.world.scene.path);
    try {
        save_bookmarks(path, s.bookmarks);
        tell(s, name + " saved in " + path.string());
    } catch (const Error& failure) {
        tell(s, failure.what());
    }
}

void toggle_recording(Session& s) {
    if (!s.recording) {
        s.recording = Path{30, double(s.yfov) * 180 / double(lw_pi), {}};
        s.recorded_seconds = 0;
        record(s, 0);
        tell(s, "recording the walk; R ends it");
        return;
    }
    const Path path = *s.recording;
    s.recording.reset();
    try {
        const std::filesystem::path file = free_name(s, "path.json");
        save_path(file, path);
        tell(s, "walk saved: lumenwalk --play " + file.string());
    } catch (const Error& failure) {
        tell(s, failure.what());
    }
}

void advance(Session& s, const WalkInput& input, float seconds) {
    if (s.transition) {
        s.transition->passed += seconds;
        s.walker = walker_at(*s.transition);
        s.yfov = yfov_at(*s.transition);
        const bool interrupted = length(input.move) > 0 || length(input.turn) > 0;
        if (interrupted) s.walker = land(s.walker, s.body, s.world.around);
        if (interrupted || s.transition->passed >= s.transition->seconds) s.transition.reset();
    } else {
        s.walker = walk(s.walker, input, seconds, s.body, s.world.around);
    }
    if (std::optional<Fade>& fade = s.lighting.fade) {
        fade->passed += seconds;
        if (fade->passed >= fade->seconds) fade.reset();
    }
    record(s, seconds);
}

FrameRequest frame_request_of(const Session& s, uint divisor) {
    FrameRequest request;
    request.camera = camera_of(s.walker, s.yfov, s.near);
    request.factors_a = factors_now(s.lighting);
    if (s.comparison.on && !is_inspection(s.viewing.view)) request.factors_b = factors_of(s.comparison.board);
    request.gather = s.viewing.gather;
    request.max_samples = is_inspection(s.viewing.view) ? 1 : s.viewing.max_samples;
    request.divisor = divisor;
    return request;
}

DisplaySettings display_settings_of(const Session& s, bool bgr) {
    const Viewing& v = s.viewing;
    const bool logarithmic = v.logarithmic && !is_signed_view(v.view);
    const ViewKind kind{v.view, v.curve, v.lines && v.view != view_shaded, s.comparison.on};
    return {kind, v.exposure_ev, v.low, v.high, logarithmic, 10, s.comparison.split, bgr};
}

std::filesystem::path free_name(const Session& s, const std::string& extension) {
    const std::string stem = s.world.scene.path.stem().string();
    for (int i = 1;; ++i) {
        char number[16];
        std::snprintf(number, sizeof number, "-%03d.", i);
        const std::filesystem::path path = s.output / (stem + number + extension);
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) return path;
    }
}

}  // namespace lw
