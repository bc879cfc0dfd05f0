#include "measure/survey.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/memory.h"
#include "maps/bake.h"
#include "maps/bake_memory.h"
#include "measure/option_parsing.h"
#include "measure/placing.h"
#include "measure/probe.h"
#include "scene/ambiance.h"
#include "scene/lamp_factors.h"
#include "trace/build_bvh.h"
#include "trace/emitter.h"

namespace lw {
namespace {

constexpr double photon_share = 0.7;  // part of the wanted error for the photons; rays get as much, as squares add
constexpr double min_lux = 1;
constexpr uint more_rays = 4;

/// The set and the index in it of a sensor in a list of all.
struct Place {
    size_t set, sensor;
};

/// The largest relative errors of a reading over all ambiances: half widths of the 90 % intervals by rays alone, by
/// photons alone, and in all.
struct Errors {
    double rays = 0, photons = 0, interval = 0;
};

Errors errors_of(const Reading& reading, const Survey& survey) {
    Errors worst;
    for (const AmbianceFactors& ambiance : survey.ambiances) {
        const Value value = value_of(reading, ambiance.factors, survey.maintenance);
        if (value.lux < min_lux || reading.blocked) continue;
        worst.rays = std::max(worst.rays, 1.9 * value.ray_error / value.lux);
        worst.photons = std::max(worst.photons, 1.645 * value.photon_error / value.lux);
        worst.interval = std::max(worst.interval, value.relative());
    }
    return worst;
}

std::vector<Place> places_of(const Survey& survey) {
    std::vector<Place> places;
    for (size_t set = 0; set < survey.sets.size(); ++set)
        for (size_t i = 0; i < survey.sets[set].set.sensors.size(); ++i) places.push_back({set, i});
    return places;
}

void read_places(const Scene& scene, const RayCaster& caster, const PhotonMap& map, const std::vector<Place>& places,
                 const MeterSettings& settings, Survey& survey) {
    std::vector<Sensor> sensors;
    for (const Place& at : places) sensors.push_back(survey.sets[at.set].set.sensors[at.sensor]);
    std::vector<Reading> readings = read_sensors(scene, caster, map, sensors, settings);
    check_is_light(readings);
    for (size_t i = 0; i < places.size(); ++i)
        survey.sets[places[i].set].readings[places[i].sensor] = std::move(readings[i]);
}

/// Reads those sensors again, with more rays, whose error by rays alone is too large.
void add_rays(const Scene& scene, const RayCaster& caster, const PhotonMap& map, const SurveySettings& settings,
              Survey& survey) {
    const double of_error = std::sqrt(1 - photon_share * photon_share) * settings.error;
    const double share = settings.error > 0 ? std::min(of_error, settings.ray_error) : settings.ray_error;
    const uint most = settings.error > 0 ? 16 * settings.max_rays : settings.max_rays;
    for (uint rays = settings.meter.rays; rays < most;) {
        rays *= more_rays;
        std::vector<Place> noisy;
        for (const Place& at : places_of(survey))
            if (errors_of(survey.sets[at.set].readings[at.sensor], survey).rays > share) noisy.push_back(at);
        if (noisy.empty()) return;
        read_places(scene, caster, map, noisy, {rays, settings.meter.seed + rays}, survey);
    }
}

/// The number of photons with which the photon error of every sensor would be small enough; that of the map when it is
/// enough.
uint64_t photons_needed(const PhotonMap& map, const SurveySettings& settings, const Survey& survey) {
    double worst = 0;
    for (const Place& at : places_of(survey))
        worst = std::max(worst, errors_of(survey.sets[at.set].readings[at.sensor], survey).photons);
    const double ratio = worst / (photon_share * settings.error);
    if (ratio <= 1) return map.stored_photons;
    return uint64_t(std::min(double(map.stored_photons) * ratio * ratio * 1.15, 1e18));
}

PhotonMap bake_again(const Scene& scene, const RayCaster& caster, const BakeSettings& before, uint64_t photons) {
    BakeSettings settings = before;
    settings.photons = photons;
    settings.radius = 0;
    return bake(scene, caster, settings);
}

std::string text_of(const char* format, auto... values) {
    char text[256];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

/// The photons of the settings, or fewer when a bake with so many would take more than `bytes`.
uint64_t affordable(const Scene& scene, const RayCaster& caster, BakeSettings settings, uint64_t bytes) {
    for (; settings.photons > 1; settings.photons /= 2)
        if (predict_bake_bytes(scene, caster, settings) <= bytes) break;
    return settings.photons;
}

void reach_error(const Scene& scene, const RayCaster& caster, PhotonMap& map, const std::vector<Place>& all,
                 const SurveySettings& settings, Survey& survey) {
    for (int tries = 0; tries < 3; ++tries) {
        BakeSettings wanted = map.settings;
        wanted.photons = std::min(photons_needed(map, settings, survey), settings.max_photons);
        const uint64_t photons =
            affordable(scene, caster, wanted, settings.memory > 0 ? settings.memory : available_memory());
        if (photons <= map.stored_photons + map.stored_photons / 50) break;
        map = bake_again(scene, caster, map.settings, photons);
        ++survey.bakes;
        read_places(scene, caster, map, all, settings.meter, survey);
        add_rays(scene, caster, map, settings, survey);
    }
    for (const Place& at : all)
        survey.unreached += errors_of(survey.sets[at.set].readings[at.sensor], survey).interval > settings.error;
    if (survey.unreached > 0)
        survey.warnings.push_back(text_of(
            "%zu sensors have an interval wider than the %.3g %% asked for; about %.3g million photons would do",
            survey.unreached, 100 * settings.error, 1e-6 * double(photons_needed(map, settings, survey))));
}

bool has_sensor_in_the_air(const Scene& scene, const RayCaster& caster, const Survey& survey) {
    const SurfaceReader surfaces(scene);
    const auto in_the_air = [&](const Sensor& sensor) {
        return !surface_under(surfaces, caster, lifted(surfaces, caster, sensor));
    };
    return std::any_of(survey.sets.begin(), survey.sets.end(), [&](const MeasuredSet& measured) {
        return std::any_of(measured.set.sensors.begin(), measured.set.sensors.end(), in_the_air);
    });
}

}  // namespace

AmbianceFactors parse_ambiance(const std::string& text, const Scene& scene) {
    const size_t colon = text.find(':');
    const std::string name = trimmed(text.substr(0, colon));
    if (colon == std::string::npos && !name.empty()) return {name, chosen_factors(scene, name, {})};
    if (name.empty()) throw Error("--ambiance \"" + text + "\": write NAME, or NAME: LAMP=FACTOR[@KELVIN], ...");
    std::vector<std::string> powers = split(text.substr(colon + 1), ',');
    std::erase(powers, "");
    return {name, parse_factors(scene, powers)};
}

Survey make_survey(const Scene& scene, const RayCaster& caster, PhotonMap map, std::vector<SensorSet> sets,
                   std::vector<AmbianceFactors> ambiances, const SurveySettings& settings) {
    Survey survey;
    for (SensorSet& set : sets) {
        if (!set.task.empty()) find_task(set.task);
        const size_t count = set.sensors.size();
        survey.sets.push_back({std::move(set), std::vector<Reading>(count), {}, {}});
    }
    survey.ambiances = std::move(ambiances);
    survey.maintenance = settings.maintenance;
    const std::vector<Place> all = places_of(survey);
    read_places(scene, caster, map, all, settings.meter, survey);
    add_rays(scene, caster, map, settings, survey);
    if (settings.error > 0) reach_error(scene, caster, map, all, settings, survey);
    survey.map = std::move(map);
    survey.caustics = share_of_caustics(scene, survey.map);
    if (survey.caustics > 0.02 && has_sensor_in_the_air(scene, caster, survey))
        survey.warnings.push_back(
            text_of("%.1f %% of the reflected light came over mirrors or lenses straight from a point, spot or sun; "
                    "sensors in the air do not see such light arrive (they see it on surfaces around)",
                    100 * survey.caustics));
    return survey;
}

void add_pins(const Scene& scene, const RayCaster& caster, Survey& survey) {
    const SurfaceReader surfaces(scene);
    std::vector<SeenPlace> places;
    std::vector<Place> sensors;
    for (const Place& at : places_of(survey)) {
        const Sensor sensor = lifted(surfaces, caster, survey.sets[at.set].set.sensors[at.sensor]);
        const std::optional<Hit> hit = surface_under(surfaces, caster, sensor);
        if (!hit) continue;
        places.push_back({*hit, sensor.position + sensor.normal});
        sensors.push_back(at);
    }
    for (MeasuredSet& measured : survey.sets)
        measured.pins.assign(survey.ambiances.size(),
                             std::vector<std::optional<Estimate>>(measured.set.sensors.size()));
    if (places.empty()) return;
    const Bvh bvh = build_bvh(scene);
    const Probe probe(scene, caster, survey.map, bvh);
    const auto maintenance = double(survey.maintenance);
    for (size_t a = 0; a < survey.ambiances.size(); ++a) {
        const std::vector<vec3> powers = lamp_powers(scene, survey.ambiances[a].factors);
        const std::vector<Measurement> read = probe.measure(powers, places);
        for (size_t i = 0; i < read.size(); ++i)
            survey.sets[sensors[i].set].pins[a][sensors[i].sensor] = {maintenance * double(read[i].lux),
                                                                      maintenance * double(read[i].half_width_lux)};
    }
}

void trace_survey(const Scene& scene, const RayCaster& caster, uint64_t paths, uint64_t seed, Survey& survey) {
    const std::vector<vec3> powers = lamp_powers(scene, survey.ambiances[0].factors);
    for (MeasuredSet& measured : survey.sets)
        measured.traced = trace_sensors(scene, caster, powers, measured.set.sensors, {paths, seed});
}

bool agrees(const Value& value, const Traced& traced, float maintenance) {
    const double truth = double(maintenance) * traced.lux, error = double(maintenance) * traced.standard_error;
    return std::abs(value.lux - truth) <= std::hypot(value.half_width, 1.645 * error);
}

Agreement agreement_of(const MeasuredSet& measured, const AmbianceFactors& ambiance, float maintenance) {
    const std::vector<Value> values = values_of(measured, ambiance, maintenance);
    Agreement result;
    for (size_t i = 0; i < measured.traced.size(); ++i) {
        const double truth = double(maintenance) * measured.traced[i].lux;
        if (!values[i].doubt.empty() || truth < min_lux) continue;
        ++result.compared;
        result.inside += agrees(values[i], measured.traced[i], maintenance);
        result.difference += values[i].lux / truth - 1;
    }
    if (result.compared > 0) result.difference /= double(result.compared);
    return result;
}

Statistics statistics_of(const MeasuredSet& measured, const AmbianceFactors& ambiance, float maintenance) {
    return statistics_of(measured.readings, values_of(measured, ambiance, maintenance),
                         measured.set.kind == SensorSet::Kind::surface);
}

std::vector<Value> values_of(const MeasuredSet& measured, const AmbianceFactors& ambiance, float maintenance) {
    std::vector<Value> values;
    for (const Reading& reading : measured.readings) values.push_back(value_of(reading, ambiance.factors, maintenance));
    return values;
}

}  // namespace lw
