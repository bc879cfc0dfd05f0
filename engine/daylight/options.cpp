#include "daylight/options.h"

#include <charconv>
#include <cmath>
#include <optional>

#include "daylight/availability.h"
#include "daylight/perez.h"
#include "daylight/weather.h"
#include "scene/profile.h"

namespace lw {
namespace {

constexpr double radian = 3.14159265358979323846 / 180;

struct Pair {
    double first, second;
};

/// "A,B", each finite and at most as large as given.
std::optional<Pair> parse_pair(const std::string& text, double most_first, double most_second) {
    Pair pair{};
    const char *at = text.data(), *end = at + text.size();
    const std::from_chars_result first = std::from_chars(at, end, pair.first);
    if (first.ec != std::errc() || first.ptr == end || *first.ptr != ',') return std::nullopt;
    const std::from_chars_result second = std::from_chars(first.ptr + 1, end, pair.second);
    if (second.ec != std::errc() || second.ptr != end) return std::nullopt;
    const bool fits = std::abs(pair.first) <= most_first && std::abs(pair.second) <= most_second;
    return fits ? std::optional(pair) : std::nullopt;
}

enum class Model { none, cie, perez };

struct Sky {
    Model model = Model::none;
    int type = 0;  // of the CIE
};

std::optional<Sky> parse_sky(const std::string& text) {
    if (text == "none") return Sky{};
    if (text == "perez") return Sky{Model::perez};
    if (text == "overcast") return Sky{Model::cie, 1};
    if (text == "uniform") return Sky{Model::cie, 5};
    if (text == "intermediate") return Sky{Model::cie, 7};
    if (text == "clear") return Sky{Model::cie, 12};
    for (int type = 1; type <= 15; ++type)
        if (text == "cie:" + std::to_string(type)) return Sky{Model::cie, type};
    return std::nullopt;
}

/// The sky of options without misuse. A weather file asks for the sky of Perez by itself.
Sky sky_of(const DaylightOptions& options) {
    return options.sky.empty() && !options.weather.empty() ? Sky{Model::perez} : parse_sky(options.sky).value_or(Sky{});
}

/// True when the sky is the same wherever the sun stands.
bool needs_no_sun(const DaylightOptions& options, const Sky& sky) {
    return sky.model == Model::cie && !cie_sky(sky.type).needs_sun() && options.diffuse >= 0 && options.direct <= 0;
}

std::string misuse_of_texts(const DaylightOptions& o) {
    if (!o.sky.empty() && !parse_sky(o.sky))
        return "--sky: must be cie:1 to cie:15, clear, intermediate, overcast, uniform, perez or none";
    if (!o.sun.empty() && !parse_pair(o.sun, 90, 360))
        return "--sun: must be ALTITUDE,AZIMUTH in degrees, such as 30,180";
    if (!o.place.empty() && !parse_pair(o.place, 90, 180))
        return "--place: must be LATITUDE,LONGITUDE in degrees, such as 48.2,16.4";
    if (!o.when.empty() && !parse_moment(o.when))
        return "--when: must be a date and time with its offset, such as 2026-06-21T15:00+02:00";
    return "";
}

/// Whether the texts go together.
std::string misuse_of_choice(const DaylightOptions& o, const Sky& sky) {
    if (sky.model == Model::none) {
        const bool given = !o.sun.empty() || !o.place.empty() || !o.when.empty() || o.diffuse >= 0 || o.direct >= 0;
        return given && o.sky.empty() ? "--sky: is needed with the options of sun and sky" : "";
    }
    if (!o.weather.empty() && o.when.empty()) return "--when: is needed with --epw, to choose the hour";
    if (!o.sun.empty() && (!o.place.empty() || !o.when.empty())) return "--sun: leaves no choice to --place and --when";
    if (sky.model == Model::perez && o.weather.empty() && (o.diffuse < 0 || o.direct < 0))
        return "--sky perez: needs --epw, or --diffuse and --direct";
    const bool has_sun = !o.sun.empty() || (!o.when.empty() && (!o.place.empty() || !o.weather.empty()));
    if (!has_sun && !needs_no_sun(o, sky)) return "--sky: needs the sun: give --sun, or --place and --when";
    return "";
}

/// The hour of a weather file, with the middle of it as the moment.
struct Measured {
    Place place;
    WeatherHour hour;
    Moment moment;
};

std::optional<Measured> measured_for(const DaylightOptions& options, const Moment& when) {
    if (options.weather.empty()) return std::nullopt;
    const Weather weather = load_weather(options.weather);
    const WeatherHour& hour = hour_at(weather, when);
    return Measured{weather.place, hour, middle_of(weather, hour, clock_time(when, weather.offset).year)};
}

SunPosition sun_of(const DaylightOptions& options, const std::optional<Measured>& measured) {
    if (const auto sun = parse_pair(options.sun, 90, 360)) return {sun->first, sun->second, 1};
    const auto place = parse_pair(options.place, 90, 180);
    const std::optional<Moment> when = parse_moment(options.when);
    if (!when || !(place || measured)) return {90, 180, 1};  // any: the sky is the same around the zenith
    return apparent_sun_position(place ? Place{place->first, place->second} : measured->place,
                                 julian_day(measured ? measured->moment : *when));
}

Irradiances irradiances_of(const DaylightOptions& options, const std::optional<Measured>& measured,
                           const SunPosition& sun) {
    Irradiances irradiances;
    irradiances.sun_zenith = (90 - sun.altitude) * radian;
    irradiances.sun_distance = sun.distance;
    if (!measured) return irradiances_of({options.direct, options.diffuse}, irradiances);
    irradiances.direct_normal = measured->hour.direct_normal;
    irradiances.diffuse_horizontal = measured->hour.diffuse_horizontal;
    irradiances.dew_point = measured->hour.dew_point;
    return irradiances;
}

/// The light of sky and sun as the weather file or the mean of such skies has it.
Illuminances usual_light(const std::optional<Irradiances>& irradiances, Cover cover, const SunPosition& sun) {
    if (irradiances) return illuminances_of(*irradiances);
    return {mean_direct(cover, sun.altitude, sun.distance), mean_diffuse(cover, sun.altitude)};
}

}  // namespace

std::string misuse_of(const DaylightOptions& options) {
    const std::string texts = misuse_of_texts(options);
    return texts.empty() ? misuse_of_choice(options, sky_of(options)) : texts;
}

bool wants_daylight(const DaylightOptions& options) { return sky_of(options).model != Model::none; }

std::unique_ptr<const Daylight> make_daylight(const DaylightOptions& options) {
    const Sky sky = sky_of(options);
    if (sky.model == Model::none) return nullptr;
    const std::optional<Moment> when = parse_moment(options.when);
    const std::optional<Measured> measured = when ? measured_for(options, *when) : std::nullopt;
    const SunPosition sun = sun_of(options, measured);
    DaylightSettings settings;
    settings.altitude = sun.altitude, settings.azimuth = sun.azimuth;
    settings.north = options.north, settings.ground_albedo = options.ground_albedo;
    const bool perez = sky.model == Model::perez;
    std::optional<Irradiances> irradiances;
    if (perez || measured) irradiances = irradiances_of(options, measured, sun);
    const SkyState state = irradiances ? sky_state(*irradiances) : SkyState{};
    settings.shape = perez ? perez_sky(state, irradiances->sun_zenith) : cie_sky(sky.type);
    const Cover cover = perez ? cover_of_clearness(state.clearness) : cover_of_cie_sky(sky.type);
    const Illuminances lux = usual_light(irradiances, cover, sun);
    settings.diffuse = options.diffuse >= 0 ? options.diffuse : lux.diffuse_horizontal;
    settings.direct = options.direct >= 0 ? options.direct : lux.direct_normal;
    if (needs_no_sun(options, sky)) settings.direct = 0;
    if (!options.grey) {
        settings.sky_color = color_of_temperature(sky_temperature(cover));
        settings.sun_color = color_of_temperature(sun_temperature(settings.altitude));
    }
    return std::make_unique<const Daylight>(settings);
}

}  // namespace lw
