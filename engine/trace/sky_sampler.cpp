#include "trace/sky_sampler.h"

#include <algorithm>
#include <cmath>

#include "shaders/color.h"
#include "trace/sampling.h"

namespace lw {
namespace {

constexpr int bands = 128, columns = 256;  // in the sine of the altitude and in azimuth; the horizon is between bands
constexpr float cell_solid_angle = 4 * lw_pi / (bands * columns);
constexpr float sun_pdf = 1 / (2 * lw_pi * float(1 - Daylight::sun_cosine));

/// The direction to a place of the map of all directions; band and column count from 0, with fractions.
vec3 direction_at(float band, float column) {
    const float y = std::clamp(2 * band / bands - 1, -1.0f, 1.0f), turn = 2 * lw_pi * column / columns;
    const float across = std::sqrt(std::max(0.0f, 1 - y * y));
    return {across * std::cos(turn), y, across * std::sin(turn)};
}

int cell_of(vec3 direction) {
    const float turns = std::atan2(direction.z, direction.x) / (2 * lw_pi);
    const int band = std::clamp(int((direction.y + 1) / 2 * bands), direction.y < 0 ? 0 : bands / 2,
                                direction.y < 0 ? bands / 2 - 1 : bands - 1);
    const int column = std::clamp(int((turns < 0 ? turns + 1 : turns) * columns), 0, columns - 1);
    return band * columns + column;
}

/// The mean luminance over a cell.
double mean_luminance(const Daylight& light, int band, int column) {
    constexpr int side = 3;
    double sum = 0;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            sum += precise_luminance(light.radiance(
                direction_at(float(band) + (float(i) + 0.5f) / side, float(column) + (float(j) + 0.5f) / side)));
    return sum / (side * side);
}

}  // namespace

SkySampler::SkySampler(const Scene& scene, const Daylight& light)
    : daylight_(light),
      centre_(0.5f * (scene.bounds[0] + scene.bounds[1])),
      radius_(0.5f * scene.size() * 1.001f),
      luminance_of_sun_(luminance(light.sun_radiance())) {
    std::vector<double> sums;
    double sum = 0;
    for (int band = 0; band < bands; ++band)
        for (int column = 0; column < columns; ++column) sums.push_back(sum += mean_luminance(light, band, column));
    const double even = 0.01 / double(sums.size());  // so that no direction is left out
    for (size_t i = 0; i < sums.size(); ++i)
        ends_.push_back(float((sum > 0 ? 0.99 * sums[i] / sum : 0) + even * double(i + 1)));
}

Incident SkySampler::incident(vec3 point, vec3 direction, vec3 radiance, float pdf) const {
    return {direction, point + direction * (length(point - centre_) + radius_), radiance, pdf};
}

Incident SkySampler::arrive(vec3 point, vec3 u) const {
    const auto found = std::upper_bound(ends_.begin(), ends_.end(), u.x * ends_.back());
    const auto cell = std::min(int(found - ends_.begin()), bands * columns - 1);
    const vec3 direction = direction_at(float(cell / columns) + u.y, float(cell % columns) + u.z);
    return incident(point, direction, daylight_.radiance(direction), pdf(direction));
}

/// Uniform over the disc.
vec3 SkySampler::direction_to_sun(float u, float v) const {
    // Uniform in 1 - cos, which keeps the precision that the cosine of so small an angle loses.
    const float below_one = u * float(1 - Daylight::sun_cosine), sine = std::sqrt(below_one * (2 - below_one));
    const float turn = 2 * lw_pi * v;
    return frame_around(daylight_.to_sun()) * vec3(sine * std::cos(turn), sine * std::sin(turn), 1 - below_one);
}

Incident SkySampler::arrive_from_sun(vec3 point, float u, float v) const {
    const vec3 direction = direction_to_sun(u, v);
    return incident(point, direction, direction.y < 0 ? vec3(0) : daylight_.sun_radiance(), sun_pdf);
}

Emission SkySampler::emit_from_sun(const std::array<float, 5>& u) const {
    const vec3 direction = -direction_to_sun(u[2], u[3]);
    const vec2 disc = sample_disc(u[0], u[1]) * radius_;
    const vec3 flux = direction.y > 0 ? vec3(0) : daylight_.sun_radiance() * (lw_pi * radius_ * radius_ / sun_pdf);
    return {centre_ + frame_around(direction) * vec3(disc.x, disc.y, -radius_), vec3(0), direction, flux};
}

float SkySampler::pdf(vec3 direction) const {
    const auto cell = size_t(cell_of(direction));
    return (ends_[cell] - (cell > 0 ? ends_[cell - 1] : 0)) / (ends_.back() * cell_solid_angle);
}

vec3 SkySampler::radiance(vec3 direction, float path_pdf, bool with_sun) const {
    const auto weight = [&](float own_pdf) { return path_pdf > 0 ? power_heuristic(path_pdf, own_pdf) : 1.0f; };
    vec3 sum = daylight_.radiance(direction) * weight(pdf(direction));
    if (with_sun && has_sun() && daylight_.is_sun(direction)) sum += daylight_.sun_radiance() * weight(sun_pdf);
    return sum;
}

std::optional<SkySampler> sky_around(const Scene& scene, const Daylight* light) {
    if (!light) return std::nullopt;
    return std::optional<SkySampler>(std::in_place, scene, *light);
}

}  // namespace lw
