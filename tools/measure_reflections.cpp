#include <cstdio>

#include "base/one_line.h"
#include "measure_options.h"
#include "scene/camera.h"
#include "scene/recorded_path.h"
#include "trace/emitter.h"

namespace lw {
namespace {

/// The cameras in which reflections are looked for: one of the scene, or those along a recorded walk.
std::vector<Camera> reflection_views(const MeasureOptions& o, const Scene& scene) {
    if (std::filesystem::path(o.reflections).extension() != ".json") return {find_camera(scene, o.reflections)};
    const Path path = load_path(o.reflections);
    std::vector<Camera> views;
    for (int i = 0; i * o.reflections_step <= path.seconds() + 1e-9; ++i) {
        views.push_back(camera_on(path, i * o.reflections_step, scene));
        char name[32];
        std::snprintf(name, sizeof name, "%g s", i * o.reflections_step);
        views.back().name = name;
    }
    return views;
}

void print_reflections(const MeasureOptions& o, const Scene& scene, const std::string& view, const std::string& powers,
                       const ReflectionReport& report) {
    std::printf("camera %s, %s: %zu reflections over %g cd/m2, %g times their surroundings and %g sr\n", view.c_str(),
                powers.c_str(), report.found.size(), o.limits.luminance, o.limits.ratio, o.limits.solid_angle);
    for (const Reflection& found : report.found)
        std::printf("  %s; %.2g sr, position index %.1f, at pixel %.0f, %.0f of %dx%d\n",
                    describe(scene, found).c_str(), found.solid_angle, found.position_index, double(found.x),
                    double(found.y), report.width, report.height);
    std::printf("UGR %s, of the lamps alone %s; background %.3g cd/m2\n", rating_text(report.ugr).c_str(),
                rating_text(report.ugr_lamps).c_str(), report.background);
}

}  // namespace

void report_reflections(const MeasureOptions& o, const Scene& scene, const RayCaster& caster) {
    const AmbianceFactors ambiance = ambiances_of(o, scene).back();
    const std::vector<vec3> powers = lamp_powers(scene, ambiance.factors);
    ReflectionSettings settings;
    settings.limits = o.limits;
    settings.seed = o.survey.meter.seed;
    std::vector<ViewedReflections> views;
    for (const Camera& camera : reflection_views(o, scene)) {
        views.push_back({camera.name, find_reflections(scene, caster, camera, powers, settings)});
        print_reflections(o, scene, camera.name, ambiance.name, views.back().report);
    }
    if (o.reflections_csv.empty()) return;
    if (views.size() == 1)
        write_reflections(o.reflections_csv, scene, views[0].report);
    else
        write_reflections(o.reflections_csv, scene, views);
    std::printf("wrote %s\n", one_line(o.reflections_csv).c_str());
}

}  // namespace lw
