// The light of sky, sun and ground around a scene, in the axes of the scene: Y up, all of it infinitely far away.
#pragma once
#include "daylight/sky_shape.h"
#include "shaders/types.h"

namespace lw {

/// A sky with its sun, over a ground that reflects both alike to all sides.
struct DaylightSettings {
    SkyShape shape;
    double diffuse = 0;    // lx on an open horizontal plane, from the sky
    double direct = 0;     // lx on a plane that faces the sun, from the sun; none comes from one below the horizon
    double altitude = 90;  // degrees, of the sun
    double azimuth = 180;  // degrees from north, clockwise seen from above
    double north = 0;      // degrees from -Z to north, clockwise seen from above
    double ground_albedo = 0.2;
    vec3 sky_color{1}, sun_color{1};  // of luminance 1
};

/// Unit direction to a place of the sky; angles in degrees, as in DaylightSettings.
vec3 direction_to(double altitude, double azimuth, double north);

class Daylight {
  public:
    /// cos of the angular radius of the sun's disc, which is 0.533 degrees wide.
    static constexpr double sun_cosine = 0.99998918;

    explicit Daylight(const DaylightSettings& settings);

    /// cd/m2, per RGB, from a unit direction: of the sky, or, below the horizon, of the ground. Without the sun.
    vec3 radiance(vec3 direction) const;
    /// cd/m2, per RGB, of the sun's disc; 0 when the sun is below the horizon.
    vec3 sun_radiance() const { return sun_radiance_; }
    /// True for a unit direction to the sun's disc above the horizon.
    bool is_sun(vec3 direction) const;
    vec3 to_sun() const { return to_sun_; }
    const DaylightSettings& settings() const { return settings_; }

  private:
    DaylightSettings settings_;
    vec3 to_sun_;
    vec3 brightest_;         // the direction around which the sky is brightest: the sun's, but not below the horizon
    vec3 unit_radiance_{0};  // where value_of() of the sky is 1
    vec3 sun_radiance_{0}, ground_radiance_{0};
};

}  // namespace lw
