// The probe against the path tracer: its 90 % interval holds the truth at 85 to 95 % of random points.
#include "measure/probe.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "maps/bake.h"
#include "scene/gltf.h"
#include "shaders/color.h"
#include "trace/build_bvh.h"
#include "trace/path_tracer.h"
#include "trace/sampling.h"

namespace lw {
namespace {

struct Baked {
    explicit Baked(const std::string& name, uint64_t photons)
        : scene(load_gltf(LUMENWALK_SOURCE_DIR "/data/" + name)), caster(scene), bvh(build_bvh(scene)) {
        map = bake(scene, caster, {.photons = photons});
    }
    Scene scene;
    RayCaster caster;
    Bvh bvh;
    PhotonMap map;
};

/// Places that someone in the room may point at: rays in all directions from where cameras stand and what they see.
std::vector<SeenPlace> random_places(const Baked& b, size_t count) {
    std::vector<SeenPlace> places;
    Rng rng(3, 0, 0);
    vec3 eye = b.scene.cameras[0].position;
    while (places.size() < count) {
        if (rng.next() < 0.2f) eye = b.scene.cameras[size_t(rng.next() * float(b.scene.cameras.size()))].position;
        const vec3 direction = direction_of(1 - 2 * rng.next(), rng.next());
        const std::optional<Hit> hit = seen_from(b.scene, b.caster, eye, direction);
        if (!hit || hit->distance < 0.02f) continue;
        const SurfaceReader surfaces(b.scene);
        const Surface s = surfaces.surface_at(hit->triangle, hit->barycentrics);
        if (s.light < 0 && !surfaces.is_purely_specular(s)) places.push_back({*hit, eye});
        eye = eye + direction * (0.5f * hit->distance);
    }
    return places;
}

struct Truth {
    double lux = 0, standard_error = 0;
};

Truth traced(const PathTracer& tracer, const Measurement& m, uint64_t seed, int samples) {
    double sum = 0, squares = 0;
    for (int i = 0; i < samples; ++i) {
        Rng rng(seed, 9, uint64_t(i));
        const vec3 e = tracer.irradiance(m.position + m.normal * 1e-5f, m.normal, rng);
        const double lux = precise_luminance(e);
        sum += lux, squares += lux * lux;
    }
    const double mean = sum / samples;
    return {mean, std::sqrt(std::max(squares / samples - mean * mean, 0.0) / samples)};
}

/// Part of the places at which the interval holds the traced value.
double coverage(const Baked& b, int samples) {
    const std::vector<vec3> weights = lamp_powers(b.scene, {});
    const PathTracer tracer(b.scene, b.caster, weights);
    const std::vector<SeenPlace> places = random_places(b, 200);
    const Probe probe(b.scene, b.caster, b.map, b.bvh);
    std::vector<int> holds(places.size());
    parallel_for(places.size(), [&](size_t i) {
        const Measurement m = probe.measure(weights, places[i]);
        const Truth truth = traced(tracer, m, i + 1, samples);
        const double half = std::hypot(double(m.half_width_lux), 1.645 * truth.standard_error);
        holds[i] = std::abs(double(m.lux) - truth.lux) <= half;
        if (getenv("LUMENWALK_PROBE_TABLE"))
            std::printf("%g %g %g %g %g %g\n", double(m.lux), truth.lux, double(m.half_width_lux), truth.standard_error,
                        double(m.bandwidth), double(m.photons));
    });
    double sum = 0;
    for (int h : holds) sum += h;
    return sum / double(places.size());
}

TEST(Probe, HoldsThePathTracersIlluminanceAsOftenAsItSaysInTheCornellBox) {
    const double part = coverage(Baked("cornell.gltf", 300'000), 3000);
    EXPECT_GE(part, 0.85);
    EXPECT_LE(part, 0.95);
}

TEST(Probe, HoldsThePathTracersIlluminanceAsOftenAsItSaysInTheApartment) {
    const double part = coverage(Baked("apartment.glb", 300'000), 1500);
    EXPECT_GE(part, 0.85);
    EXPECT_LE(part, 0.95);
}

TEST(Probe, SharesAddUpToTheWholeAndFollowTheirLamps) {
    const Baked b("apartment.glb", 50'000);
    const SeenPlace place = random_places(b, 5).back();
    std::vector<vec3> powers = lamp_powers(b.scene, {});
    const Probe probe(b.scene, b.caster, b.map, b.bvh);
    const Measurement all = probe.measure(powers, place);
    float sum = 0;
    for (const LampShare& share : all.lamps) sum += share.lux;
    EXPECT_NEAR(sum, all.lux, 1e-4f * all.lux);
    for (size_t lamp = 0; lamp < powers.size(); ++lamp) {
        std::vector<vec3> one(powers.size(), vec3(0));
        one[lamp] = powers[lamp];
        const Measurement alone = probe.measure(one, place);
        EXPECT_NEAR(alone.lux, all.lamps[lamp].lux, 1e-4f * all.lux) << b.scene.light_names[lamp];
    }
}

}  // namespace
}  // namespace lw
