#include "cie171_laboratory.h"

#include <cmath>

#include "maps/bake.h"
#include "measure/grid.h"

namespace lw {

double configuration_factor(glm::dvec3 point, glm::dvec3 normal, const Corners& polygon) {
    double sum = 0;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a = glm::normalize(polygon[i] - point),
                         b = glm::normalize(polygon[(i + 1) % polygon.size()] - point);
        sum += std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(glm::cross(a, b)), normal);
    }
    return std::abs(sum) / (2 * 3.14159265358979323846);
}

Corners rectangle(glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v) {
    return {corner, corner + u, corner + u + v, corner + v};
}

Sensor facing(vec3 position, vec3 normal, Response response) { return {position, normalize(normal), response}; }

Survey Laboratory::measure(const Scene& scene, std::vector<SensorSet> sets) const {
    const RayCaster caster(scene);
    SurveySettings survey;
    survey.ray_error = 0.008;
    return make_survey(scene, caster, bake(scene, caster, {.photons = photons_}), std::move(sets),
                       {{"all", std::vector<vec3>(scene.lights.size(), vec3(1))}}, survey);
}

void Laboratory::add(const CieCase& name, const Scene& scene, const std::vector<Sensor>& sensors,
                     const std::vector<double>& expected, const std::vector<double>& published) {
    const Survey survey = measure(scene, {{SensorSet::Kind::points, "points", "", sensors, {}, {}}});
    const std::vector<Value> values = values_of(survey.sets[0], survey.ambiances[0], 1);
    for (size_t i = 0; i < sensors.size(); ++i) {
        results.push_back(
            {name.section, name.what, name.formula, expected[i], values[i].lux, values[i].half_width, {}});
        if (!published.empty()) results.back().published = published[i];
    }
}

Estimate Laboratory::mean_of_room(const Scene& scene, uint count) const {
    std::vector<SensorSet> sets;
    for (const char* face : {"floor", "ceiling", "west", "east", "north", "south"})
        sets.push_back(make_surface(std::string(face) + ": count=" + std::to_string(count), scene));
    const Survey survey = measure(scene, std::move(sets));
    Estimate mean;
    for (const MeasuredSet& set : survey.sets) {
        const Statistics s = statistics_of(set.readings, values_of(set, survey.ambiances[0], 1));
        mean.value += s.average.value / 6, mean.half_width += s.average.half_width / 6;
    }
    return mean;
}

void Laboratory::add_flux(const CieCase& name, const Scene& scene, double area, double expected) {
    const Estimate mean = mean_of_room(scene, 400);
    results.push_back(
        {name.section, name.what, name.formula, expected, mean.value * 6 * area, mean.half_width * 6 * area, {}});
}

void Laboratory::add_grid(const CieCase& name, const Scene& scene, const std::string& grid, double expected) {
    const Survey survey = measure(scene, {make_grid(parse_grid(grid), scene)});
    const Statistics s = statistics_of(survey.sets[0].readings, values_of(survey.sets[0], survey.ambiances[0], 1));
    results.push_back({name.section, name.what, name.formula, expected, s.average.value, s.average.half_width, {}});
}

}  // namespace lw
