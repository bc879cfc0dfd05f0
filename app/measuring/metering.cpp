#include "app/measuring/metering.h"

#include <algorithm>
#include <cmath>

#include "app/session/actions.h"
#include "app/session/saving.h"
#include "base/error.h"
#include "base/replaced_file.h"
#include "measure/table.h"
#include "scene/camera.h"
#include "scene/surface.h"
#include "trace/emitter.h"

namespace lw {
namespace {

Pin measured(const Session& s, const Probe& probe, const Hit& hit, vec3 viewer) {
    return {hit, viewer, probe.measure(lamp_powers(s.world.scene, factors_now(s.lighting)), {hit, viewer})};
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

/// The point that a picture of `size` pixels shows at `pixel`, if any.
std::optional<Hit> hit_at(const Session& s, vec2 pixel, vec2 size) {
    const Camera camera = camera_of(s.walker, s.yfov, s.near);
    const CameraRay ray = camera_ray(camera, pixel.x, pixel.y, int(size.x), int(size.y));
    return seen_from(s.world.scene, s.world.caster, ray.origin, ray.direction);
}

void check_is_light(const Measurement& m, size_t pin) {
    for (float lux : {m.lux, m.half_width_lux, m.luminance})
        if (!std::isfinite(lux) || lux < 0)
            throw Error("pin " + std::to_string(pin) + " reads " + std::to_string(lux) + ", which is no light");
}

void write_table(const std::filesystem::path& path, const std::string& text) {
    ReplacedFile file(path);
    file.stream() << text;
    file.commit();
}

}  // namespace

void measure_again(Session& s, const Probe& probe, bool all) {
    s.metering.live.reset();
    if (s.metering.on)
        if (const auto hit = hit_at(s, vec2(0.5f), vec2(1))) s.metering.live = measured(s, probe, *hit, s.walker.eye);
    if (all)
        for (Pin& pin : s.metering.pins) pin = measured(s, probe, pin.hit, pin.viewer);
}

void pin_at(Session& s, const Probe& probe, vec2 pixel, vec2 size) {
    if (const auto hit = hit_at(s, pixel, size)) s.metering.pins.push_back(measured(s, probe, *hit, s.walker.eye));
}

void save_pins(Session& s) {
    const Scene& scene = s.world.scene;
    try {
        const std::filesystem::path path = free_name(s, "csv");
        ReplacedFile file(path);
        std::ostream& out = file.stream();
        out << "pin,x m,y m,z m,illuminance lx,low lx,high lx,luminance cd/m2,material,triangle";
        for (const std::string& name : scene.light_names) out << "," << quoted(name + " lx");
        out << "\n";
        for (size_t i = 0; i < s.metering.pins.size(); ++i) {
            const Measurement& m = s.metering.pins[i].value;
            check_is_light(m, i + 1);
            const glm::dvec3 at = scene.origin + glm::dvec3(m.position);
            const uint material = scene.objects[scene.triangle_objects[m.triangle]].material;
            out << i + 1 << "," << at.x << "," << at.y << "," << at.z << "," << m.lux << ","
                << std::max(m.lux - m.half_width_lux, 0.0f) << "," << m.lux + m.half_width_lux << "," << m.luminance
                << "," << quoted(scene.material_names[material]) << "," << m.triangle;
            for (const LampShare& share : m.lamps) out << "," << share.lux;
            out << "\n";
        }
        file.commit();
        tell(s, std::to_string(s.metering.pins.size()) + " pins saved in " + path.string());
    } catch (const Error& failure) {
        tell(s, failure.what());
    }
}

void toggle_field_choice(Session& s) {
    s.fields.chooses = !s.fields.chooses;
    s.fields.corner.reset();
    if (s.fields.chooses) tell(s, "click two opposite corners of the calculation grid; G or Esc gives up", 8);
}

void choose_corner(Session& s, vec2 pixel, vec2 size) {
    const auto hit = hit_at(s, pixel, size);
    if (!hit) return tell(s, "nothing here to put a corner on", 2);
    const vec3 point = SurfaceReader(s.world.scene).surface_at(hit->triangle, hit->barycentrics).position;
    if (!s.fields.corner) {
        s.fields.corner = point;
        return tell(s, "now the opposite corner", 8);
    }
    try {
        add_field(s.fields, request_between(s.fields, *s.fields.corner, point, s.world.scene), s.world.scene);
        s.fields.text = text_of(s.fields.fields.back().request);
        tell(s, s.fields.text, 5);
    } catch (const Error& failure) {
        tell(s, failure.what());
    }
    s.fields.chooses = false;
    s.fields.corner.reset();
}

void add_written_field(Session& s) {
    try {
        add_field(s.fields, parse_grid(s.fields.text), s.world.scene);
    } catch (const Error& failure) {
        tell(s, failure.what(), 8);
    }
}

void save_fields(Session& s) {
    try {
        const Survey survey = survey_of(s.fields, factors_now(s.lighting),
                                        s.lighting.current.empty() ? "lamps as set" : s.lighting.current);
        const std::filesystem::path sums = free_name(s, "grids.csv"), points = free_name(s, "sensors.csv");
        write_table(sums, fields_as_csv(survey));
        write_table(points, sensors_as_csv(survey, s.world.scene));
        tell(s, std::to_string(survey.sets.size()) + " grids saved in " + sums.string() + " and " +
                    points.filename().string());
    } catch (const Error& failure) {
        tell(s, failure.what());
    }
}

}  // namespace lw
