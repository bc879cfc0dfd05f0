#include "measure/sensor.h"

#include <algorithm>
#include <cmath>

#include "trace/sampling.h"

namespace lw {

float response_to(const Sensor& sensor, vec3 to_light) {
    const float cosine = dot(sensor.normal, to_light);
    if (sensor.response == Response::planar) return std::max(cosine, 0.0f);
    return std::sqrt(std::max(1 - cosine * cosine, 0.0f)) / lw_pi;
}

SensedDirection sample_direction(const Sensor& sensor, float u, float v, float w) {
    const mat3 frame = frame_around(sensor.normal);
    if (sensor.response == Response::planar) return {frame * sample_cosine(u, v), lw_pi};
    // The density of the cosine to the axis is proportional to the sine: that of one coordinate of a uniform disc.
    return {frame * direction_of(sample_disc(u, v).x, w), lw_pi};
}

}  // namespace lw
