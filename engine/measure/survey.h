// A survey: all sets of sensors are read, for any number of ambiances, with more rays and more photons until the wanted
// error is reached.
#pragma once
#include <optional>

#include "measure/light_meter.h"
#include "measure/statistics.h"
#include "measure/traced.h"

namespace lw {

/// An ambiance of the survey.
struct AmbianceFactors {
    std::string name;
    std::vector<vec3> factors;  // RGB per lamp, times its power in the file
};

/// Parses "NAME", one of the scene's ambiances, or "NAME: LAMP=FACTOR[@KELVIN], ...", where lamps not named have factor
/// 1. Throws Error for an unknown name or lamp.
AmbianceFactors parse_ambiance(const std::string& text, const Scene& scene);

struct MeasuredSet {
    SensorSet set;
    std::vector<Reading> readings;
    std::vector<std::vector<std::optional<Estimate>>> pins;  // per ambiance, then per sensor: see add_pins()
    std::vector<Traced> traced;                              // per sensor, or empty: see trace_survey()
};

struct SurveySettings {
    MeterSettings meter;
    double error = 0;          // wanted half width of the 90 % interval over the value; 0: what the map's photons give
    double ray_error = 0.02;   // the same by rays alone; a sensor gets more rays until it is reached
    uint max_rays = 1u << 14;  // per sensor; 16 times as many with `error`
    uint64_t max_photons = 64'000'000;
    uint64_t memory = 0;    // bytes that a bake for `error` may use; 0: what the machine has available
    float maintenance = 1;  // maintenance factor: the part of the lamps' light that is left after ageing and dirt
};

struct Survey {
    std::vector<MeasuredSet> sets;
    std::vector<AmbianceFactors> ambiances;
    float maintenance = 1;
    PhotonMap map;         // the map of the last readings
    uint64_t bakes = 0;    // maps made to reach the error
    double caustics = 0;   // share_of_caustics() of that map
    size_t unreached = 0;  // sensors whose error stayed above settings.error
    std::vector<std::string> warnings;
};

/// Reads the sets from `map`. Sensors are read again with four times the rays until the error of the rays is small
/// enough. With settings.error the scene is then baked again with more photons, at the map's other settings, until all
/// errors are. Sensors below 1 lx and blocked ones may keep a larger error. Throws Error when interrupted.
Survey make_survey(const Scene& scene, const RayCaster& caster, PhotonMap map, std::vector<SensorSet> sets,
                   std::vector<AmbianceFactors> ambiances, const SurveySettings& settings);

/// Fills MeasuredSet::pins: for each planar sensor that lies on a surface, the value that a pin of the walkthrough
/// shows there. It is estimated from the photons on that surface itself (measure/probe.h), so it is an independent
/// check.
void add_pins(const Scene& scene, const RayCaster& caster, Survey& survey);

/// Fills MeasuredSet::traced: path traces every sensor that is not blocked, in the first ambiance, with `paths` paths
/// each.
void trace_survey(const Scene& scene, const RayCaster& caster, uint64_t paths, uint64_t seed, Survey& survey);

/// The statistics of one set in one ambiance.
Statistics statistics_of(const MeasuredSet& measured, const AmbianceFactors& ambiance, float maintenance);

/// The values of one set in one ambiance, one per sensor.
std::vector<Value> values_of(const MeasuredSet& measured, const AmbianceFactors& ambiance, float maintenance);

/// How well the values of a set agree with the path tracer.
struct Agreement {
    size_t compared = 0;    // sensors compared: those above 1 lx that have no doubt
    size_t inside = 0;      // of these, sensors whose difference lies within its 90 % interval
    double difference = 0;  // mean of value / traced - 1
};
Agreement agreement_of(const MeasuredSet& measured, const AmbianceFactors& ambiance, float maintenance);

/// True when a value and a path-traced one differ by no more than the 90 % interval of their difference.
bool agrees(const Value& value, const Traced& traced, float maintenance);

}  // namespace lw
