#include "app/measuring/fields.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"

namespace lw {
namespace {

constexpr double thinnest = 0.1;  // m

const char* axis_name(vec3 facing) {
    constexpr const char* names[] = {"+x", "-x", "+y", "-y", "+z", "-z"};
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(facing[axis]) > 0.5f) return names[2 * axis + (facing[axis] < 0)];
    return "+y";
}

}  // namespace

void add_field(Fields& fields, const GridRequest& request, const Scene& scene) {
    Field field;
    field.request = request;
    field.set = make_grid(request, scene);
    if (field.set.sensors.size() > max_sensors)
        throw Error("grid \"" + request.name + "\": " + std::to_string(field.set.sensors.size()) + " points; at most " +
                    std::to_string(max_sensors) + " in the window, more by lumenwalk-measure");
    field.id = fields.next_id++;
    fields.fields.push_back(std::move(field));
}

GridRequest request_between(const Fields& fields, vec3 first, vec3 second, const Scene& scene) {
    const glm::dvec3 a = scene.origin + glm::dvec3(first), b = scene.origin + glm::dvec3(second);
    const double height = a.y + double(fields.height);
    GridRequest request;
    request.name = "grid " + std::to_string(fields.next_id);
    request.low = {std::min(a.x, b.x), height, std::min(a.z, b.z)};
    request.high = {std::max(a.x, b.x), height, std::max(a.z, b.z)};
    if (request.high.x - request.low.x < thinnest || request.high.z - request.low.z < thinnest)
        throw Error("a grid is at least 10 cm wide: click two corners further apart");
    return request;
}

std::string text_of(const GridRequest& r) {
    char text[256];
    std::snprintf(text, sizeof text, ": %.3f,%.3f,%.3f to %.3f,%.3f,%.3f", r.low.x, r.low.y, r.low.z, r.high.x,
                  r.high.y, r.high.z);
    std::string result = r.name + text;
    if (std::string(axis_name(r.facing)) != "+y") result += std::string(" facing=") + axis_name(r.facing);
    for (const auto& [key, value] : {std::pair{"margin", r.margin}, std::pair{"spacing", r.spacing}}) {
        std::snprintf(text, sizeof text, " %s=%g", key, value);
        if (value > 0) result += text;
    }
    if (r.response == Response::cylindrical) result += " kind=cylindrical";
    return result + (r.task.empty() ? "" : " task=" + r.task);
}

void value_fields(Fields& fields, const std::vector<vec3>& factors) {
    for (Field& field : fields.fields) {
        if (field.readings.empty()) continue;
        field.values.clear();
        for (const Reading& reading : field.readings) field.values.push_back(value_of(reading, factors));
        field.statistics = statistics_of(field.readings, field.values);
    }
}

std::string summary_of(const Field& field) {
    if (field.readings.empty()) return "being read";
    const Statistics& s = field.statistics;
    if (s.count == 0) return "all of it inside things";
    char text[160];
    std::snprintf(text, sizeof text, "Eavg %.4g lx +- %.2g\nEmin %.4g, Emax %.4g\nU0 %.2f, Ud %.2f", s.average.value,
                  s.average.half_width, s.minimum.value, s.maximum.value, s.u0.value, s.ud.value);
    std::string result = text;
    if (!field.request.task.empty())
        result += "\n" + field.request.task + ": " + name_of(judge(s, find_task(field.request.task)).both());
    if (s.doubtful > 0) result += "\n" + std::to_string(s.doubtful) + " points not to be trusted";
    return result + (field.is_current ? "" : "\nbeing read again");
}

Survey survey_of(const Fields& fields, const std::vector<vec3>& factors, const std::string& name) {
    Survey survey;
    survey.ambiances = {{name, factors}};
    for (const Field& field : fields.fields)
        if (!field.readings.empty()) survey.sets.push_back({field.set, field.readings, {}, {}});
    return survey;
}

}  // namespace lw
