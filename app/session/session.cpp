#include "app/session/session.h"

namespace lw {

Session::Session(const World& w, std::filesystem::path folder)
    : world(w),
      output(std::move(folder)),
      body(body_for(w.scene)),
      walker(walker_at(w.scene.cameras[0], body, w.collision)),
      yfov(w.scene.cameras[0].yfov),
      near(w.scene.cameras[0].near) {
    lighting.lamps.resize(w.scene.lights.size());
    comparison.lamps = lighting.lamps;
}

Session::Session(const World& w, const Session& before) : Session(w, before.output) {
    body = before.body;
    walker = before.walker;
    yfov = before.yfov;
    bookmarks = before.bookmarks;
    bookmarks_error = before.bookmarks_error;
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

std::vector<vec3> factors_now(const Lighting& lighting) {
    const std::vector<vec3> target = factors_of(lighting.lamps);
    if (!lighting.fade) return target;
    return mixed(lighting.fade->from, target, lighting.fade->passed / lighting.fade->seconds);
}

FrameRequest frame_request_of(const Session& s, uint divisor) {
    FrameRequest request;
    request.camera = camera_of(s.walker, s.yfov, s.near);
    request.factors_a = factors_now(s.lighting);
    if (s.comparison.on && !is_inspection(s.viewing.view)) request.factors_b = factors_of(s.comparison.lamps);
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

}  // namespace lw
