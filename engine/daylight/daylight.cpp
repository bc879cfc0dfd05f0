#include "daylight/daylight.h"

#include <algorithm>
#include <cmath>

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;

}  // namespace

vec3 direction_to(double altitude, double azimuth, double north) {
    const double up = altitude * pi / 180, turn = (azimuth + north) * pi / 180;
    return {float(std::cos(up) * std::sin(turn)), float(std::sin(up)), float(-std::cos(up) * std::cos(turn))};
}

Daylight::Daylight(const DaylightSettings& settings)
    : settings_(settings),
      to_sun_(direction_to(settings.altitude, settings.azimuth, settings.north)),
      brightest_(direction_to(std::max(settings.altitude, 0.0), settings.azimuth, settings.north)) {
    const double sine = std::sin(settings.altitude * pi / 180), sun_zenith = std::acos(std::max(sine, 0.0));
    if (settings.diffuse > 0)
        unit_radiance_ = settings.sky_color * float(settings.diffuse / horizontal_value(settings.shape, sun_zenith));
    const double direct = sine > 0 ? settings.direct : 0;
    // A disc of even radiance L gives L pi sin^2 r on a plane that faces it.
    sun_radiance_ = settings.sun_color * float(direct / (pi * (1 - sun_cosine * sun_cosine)));
    const vec3 horizontal =
        settings.sky_color * float(settings.diffuse) + settings.sun_color * float(direct * std::max(sine, 0.0));
    ground_radiance_ = horizontal * float(settings.ground_albedo / pi);
}

vec3 Daylight::radiance(vec3 direction) const {
    if (direction.y < 0) return ground_radiance_;
    const double cosine = double(dot(direction, brightest_));
    return unit_radiance_ * float(value_of(settings_.shape, double(direction.y), cosine));
}

bool Daylight::is_sun(vec3 direction) const {
    if (direction.y < 0) return false;
    // The distance of the tips keeps the precision that the cosine of so small an angle loses.
    const vec3 apart = direction - to_sun_;
    return double(dot(apart, apart)) <= 2 * (1 - sun_cosine);
}

}  // namespace lw
