#include "measure/glare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/parallel.h"
#include "measure/guth.h"
#include "shaders/color.h"
#include "trace/sampling.h"

namespace lw {
namespace {}  // namespace

double glare_of(const GlareSource& source, vec3 forward, vec3 up) {
    const double p = position_index(source.direction, forward, up);
    return source.luminance * source.luminance * source.solid_angle / (p * p);
}

double unified_glare_rating(double sum_of_glare, double background) {
    if (!(sum_of_glare > 0)) return -std::numeric_limits<double>::infinity();
    return 8 * std::log10(0.25 * sum_of_glare / std::max(background, 1e-6));
}

std::string rating_text(double rating) {
    if (!std::isfinite(rating)) return "none";
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", rating);
    return text;
}

std::vector<GlareSource> find_visible_lamps(const Scene& scene, const RayCaster& caster, const Camera& camera,
                                            std::span<const vec3> powers, uint samples) {
    const Emitters emitters(scene);
    const vec3 forward = -camera.rotation[2];
    std::vector<GlareSource> found;
    for (uint lamp = 0; lamp < scene.lights.size(); ++lamp) {
        if (!has_surface(scene.lights[lamp].type)) continue;
        GlareSource source{lamp, 0, 0, vec3(0)};
        for (uint i = 0; i < samples; ++i) {
            const auto in = emitters.arrive(lamp, camera.position, sobol_owen(i, 0, lamp), sobol_owen(i, 1, lamp));
            if (!in || dot(in->to_light, forward) <= 0) continue;
            const vec3 passed = caster.transmittance(camera.position, in->position);
            const double seen = precise_luminance(in->radiance * passed * powers[lamp]);
            if (!(seen > 0)) continue;
            const double part = 1 / (double(in->pdf) * samples);
            source.luminance += seen * part;
            source.solid_angle += part;
            source.direction += in->to_light * float(part);
        }
        if (!(source.solid_angle > 0)) continue;
        source.luminance /= source.solid_angle;
        source.direction = normalize(source.direction);
        found.push_back(source);
    }
    return found;
}

double background_luminance(const Scene& scene, const RayCaster& caster, const Camera& camera,
                            std::span<const vec3> powers, uint samples) {
    const PathTracer tracer(scene, caster, {powers.begin(), powers.end()});
    const Emitters emitters(scene);
    const vec3 forward = -camera.rotation[2];
    std::vector<double> indirect(samples, 0);
    parallel_for(
        samples,
        [&](size_t i) {
            Rng rng(11, 3, i);
            double straight = 0;
            for (uint lamp = 0; lamp < scene.lights.size(); ++lamp) {
                const float u = rng.next(), v = rng.next();
                const auto in = emitters.arrive(lamp, camera.position, u, v);
                if (!in || dot(in->to_light, forward) <= 0) continue;
                const vec3 passed = caster.transmittance(camera.position, in->position);
                straight += precise_luminance(in->radiance * passed * powers[lamp]) *
                            double(dot(in->to_light, forward)) / (in->pdf > 0 ? double(in->pdf) : 1.0);
            }
            indirect[i] = precise_luminance(tracer.irradiance(camera.position, forward, rng)) - straight;
        },
        64);
    double sum = 0;
    for (double e : indirect) sum += e;
    return std::max(sum / samples, 0.0) / M_PI;
}

}  // namespace lw
