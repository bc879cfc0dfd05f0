#include "measure/view.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "maps/estimate.h"
#include "scene/camera.h"
#include "shaders/color.h"
#include "trace/build_bvh.h"
#include "trace/emitter.h"

namespace lw {
namespace {

constexpr std::array<uint8_t, 3> cut_color{70, 70, 80}, outside_color{255, 255, 255};

/// Light grey drawing of a surface: its colour, lightened, shaded by its slope.
std::array<uint8_t, 3> drawn(const Surface& s, vec3 direction) {
    const float slope = 0.55f + 0.45f * std::abs(dot(s.geometric_normal, direction));
    std::array<uint8_t, 3> rgb{};
    for (int c = 0; c < 3; ++c)
        rgb[size_t(c)] = uint8_t(255 * clamp((0.35f + 0.65f * std::sqrt(s.base_color[c])) * slope, 0.0f, 1.0f));
    return rgb;
}

}  // namespace

Rgb8Image plan_view(const Scene& scene, const RayCaster& caster, const SensorSet& grid, float band, int width) {
    const SurfaceReader surfaces(scene);
    const vec3 across = grid.grid.across * float(grid.grid.columns), along = grid.grid.along * float(grid.grid.rows);
    const vec3 right = normalize(across), down = normalize(along), view = -grid.sensors[0].normal;
    const float wide = length(across) + 2 * band, tall = length(along) + 2 * band;
    Rgb8Image image{width, std::max(1, int(std::lround(float(width) * tall / wide))), {}};
    image.rgb.resize(3 * image.pixel_count());
    const vec3 corner = grid.grid.corner - (right + down) * band;
    parallel_for(size_t(image.height), [&](size_t y) {
        for (int x = 0; x < width; ++x) {
            const vec3 from = corner + right * ((float(x) + 0.5f) * wide / float(width)) +
                              down * ((float(y) + 0.5f) * tall / float(image.height)) - view * 2e-3f;
            const auto hit = caster.nearest(from, view);
            std::array<uint8_t, 3> rgb = outside_color;
            if (hit) {
                const Surface s = surfaces.surface_at(hit->triangle, hit->barycentrics);
                const bool inside = dot(s.geometric_normal, view) > 0 && !(s.flags & material_double_sided);
                rgb = inside ? cut_color : drawn(s, view);
            }
            std::copy(rgb.begin(), rgb.end(), image.rgb.begin() + ptrdiff_t(3 * (y * size_t(width) + size_t(x))));
        }
    });
    return image;
}

std::vector<double> seen_illuminance(const Scene& scene, const RayCaster& caster, const PhotonMap& map,
                                     const Camera& camera, const AmbianceFactors& ambiance, int width, int height) {
    const std::vector<vec3> powers = lamp_powers(scene, ambiance.factors);
    const Bvh bvh = build_bvh(scene);
    const PhotonEstimator estimator(scene, map, powers, {}, bvh);
    std::vector<double> lux(size_t(width) * size_t(height), 0);
    parallel_for(size_t(height), [&](size_t y) {
        for (int x = 0; x < width; ++x) {
            const CameraRay ray = camera_ray(camera, float(x) + 0.5f, float(y) + 0.5f, width, height);
            const auto hit = caster.nearest(ray.origin, ray.direction);
            if (!hit) continue;
            const size_t pixel = y * size_t(width) + size_t(x);
            lux[pixel] = double(luminance(
                estimator.estimate(hit->triangle, hit->barycentrics, -ray.direction, uint(pixel)).irradiance));
        }
    });
    return lux;
}

std::pair<double, double> range_of_picture(std::vector<double> lux) {
    std::erase_if(lux, [](double value) { return !(value > 0); });
    if (lux.empty()) return {1e-8, 1e-6};
    std::sort(lux.begin(), lux.end());
    const double high = lux[lux.size() * 99 / 100];
    return {std::clamp(lux[lux.size() / 100], high * 1e-3, high * 0.5), high};
}

}  // namespace lw
