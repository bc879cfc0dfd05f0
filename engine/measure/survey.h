// A whole survey: all sets of sensors read, for any number of ambiances; more rays and more photons until the error
// asked for is reached.
#pragma once
#include <optional>

#include "measure/light_meter.h"
#include "measure/statistics.h"
#include "measure/traced.h"

namespace lw {

/// A named set of powers.
struct AmbianceFactors {
    std::string name;
    std::vector<vec3> factors;  // per lamp and colour, of the power in the file
};

/// "NAME" of the scene's ambiances, or "NAME: LAMP=FACTOR[@KELVIN], ..." (lamps not named stay at 1). Throws Error
/// for an unknown name or lamp.
AmbianceFactors parse_ambiance(const std::string& text, const Scene& scene);

struct MeasuredSet {
    SensorSet set;
    std::vector<Reading> readings;
    std::vector<std::vector<std::optional<Estimate>>> pins;  // of each ambiance, then of each sensor: see add_pins()
    std::vector<Traced> traced;                              // of each sensor, or empty: see trace_survey()
};

struct SurveySettings {
    MeterSettings meter;
    double error = 0;          // largest half width of the 90 % interval over the value; 0: whatever the photons give
    double ray_error = 0.02;   // part of that which rays may leave; a sensor gets more of them until it is reached
    uint max_rays = 1u << 14;  // per sensor; 16 times as many with `error`
    uint64_t max_photons = 64'000'000;
    uint64_t memory = 0;    // bytes a bake for `error` may take; 0: what the machine has available
    float maintenance = 1;  // part of the lamps' light that is left (maintenance factor)
};

struct Survey {
    std::vector<MeasuredSet> sets;
    std::vector<AmbianceFactors> ambiances;
    float maintenance = 1;
    PhotonMap map;         // that was read last
    uint64_t bakes = 0;    // maps made to reach the error
    double caustics = 0;   // share_of_caustics() of that map
    size_t unreached = 0;  // sensors whose error stayed above the one asked for
    std::vector<std::string> warnings;
};

/// Reads the sets from `map`; sensors are read again with four times the rays until the rays' part of the error is
/// small enough. With settings.error the scene is baked again with the photons that the rest needs, at the map's own
/// settings. Sensors under 1 lx, and blocked ones, are not waited for. Throws Error when interrupted.
Survey make_survey(const Scene& scene, const RayCaster& caster, PhotonMap map, std::vector<SensorSet> sets,
                   std::vector<AmbianceFactors> ambiances, const SurveySettings& settings);

/// Beside the values of planar sensors that lie on surfaces: what a pin of the walkthrough reads there, from the
/// photons on that very surface (maps/probe.h), another estimator of the same light.
void add_pins(const Scene& scene, const RayCaster& caster, Survey& survey);

/// Path traces every sensor that is not blocked in the first ambiance with `paths` paths.
void trace_survey(const Scene& scene, const RayCaster& caster, uint64_t paths, uint64_t seed, Survey& survey);

/// The sums of one set in one ambiance.
Statistics statistics_of(const MeasuredSet& measured, const AmbianceFactors& ambiance, float maintenance);

/// The values of one set in one ambiance.
std::vector<Value> values_of(const MeasuredSet& measured, const AmbianceFactors& ambiance, float maintenance);

/// How the values of a set agree with the path tracer.
struct Agreement {
    size_t compared = 0;    // trusted sensors over 1 lx
    size_t inside = 0;      // whose difference lies within the 90 % interval of the difference
    double difference = 0;  // mean of value / traced - 1
};
Agreement agreement_of(const MeasuredSet& measured, const AmbianceFactors& ambiance, float maintenance);

/// Whether a value and a traced one agree: their difference lies in the interval, the traced one's error added.
bool agrees(const Value& value, const Traced& traced, float maintenance);

}  // namespace lw
