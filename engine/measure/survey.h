// A whole survey: all sets of sensors read, for any number of ambiances; more rays and more photons until the error
// asked for is reached.
#pragma once
#include <optional>

#include "measure/light_meter.h"
#include "measure/statistics.h"

namespace lw {

/// A named set of powers.
struct PowerSetting {
    std::string name;
    std::vector<float> factors;  // per lamp, of the power in the file
};

/// Factors per channel as factors of the lamp's own luminous power: exact for light of the lamp's colour.
std::vector<float> luminous_factors(const Scene& scene, const std::vector<vec3>& factors);

/// "NAME" of the scene's ambiances, or "NAME: LAMP=FACTOR, LAMP=FACTOR ..." (lamps not named stay at 1). Throws Error
/// for an unknown name or lamp.
PowerSetting parse_ambiance(const std::string& text, const Scene& scene);

struct MeasuredSet {
    SensorSet set;
    std::vector<Reading> readings;
};

struct SurveySettings {
    MeterSettings meter;
    double error = 0;           // largest half width of the 90 % interval over the value; 0: whatever the photons give
    double ray_error = 0.02;    // part of that which rays may leave; a sensor gets more of them until it is reached
    uint most_rays = 1u << 14;  // per sensor; 16 times as many with `error`
    uint64_t most_photons = 64'000'000;
    float maintenance = 1;  // part of the lamps' light that is left (maintenance factor)
};

struct Survey {
    std::vector<MeasuredSet> sets;
    std::vector<PowerSetting> ambiances;
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
                   std::vector<PowerSetting> ambiances, const SurveySettings& settings);

/// The sums of one set in one ambiance.
Statistics statistics_of(const MeasuredSet& measured, const Scene& scene, const PowerSetting& ambiance,
                         float maintenance);

/// The values of one set in one ambiance.
std::vector<Value> values_of(const MeasuredSet& measured, const Scene& scene, const PowerSetting& ambiance,
                             float maintenance);

}  // namespace lw
