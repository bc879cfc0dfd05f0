// The samplers and the path tracer against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "scene/gltf.h"
#include "trace/bsdf.h"
#include "trace/chi_square.h"
#include "trace/path_tracer.h"
#include "trace/sampling.h"

namespace lw {
namespace {

std::string file_in_data(const std::string& name) { return std::string(LUMENWALK_SOURCE_DIR "/data/") + name; }

Surface material(float metallic, float roughness, float specular, vec3 color) {
    Surface s{};
    s.geometric_normal = s.normal = vec3(0, 0, 1);
    s.base_color = color;
    s.metallic = metallic;
    s.roughness = roughness;
    s.specular = specular;
    s.specular_color = vec3(1);
    s.ior = 1.5f;
    s.light = -1;
    return s;
}

TEST(Sampling, DirectionsOfTheBsdfFollowTheirPdf) {
    Scene empty;
    const SurfaceReader reader(empty);
    const vec3 view = normalize(vec3(0.5f, 0.2f, 0.7f));
    for (const Surface& s : {material(0, 1, 0, vec3(0.5f)), material(1, 0.5f, 1, vec3(0.8f)),
                             material(0, 0.6f, 1, vec3(0.3f)), material(0.5f, 0.8f, 1, vec3(0.6f))}) {
        test::ChiSquare chi2{.low = 0, .rows = 10, .columns = 20, .samples = 400000};
        chi2.test(reader, s, view);
        EXPECT_GT(chi2.degrees, 20);
        EXPECT_LT(chi2.sum, chi2.degrees + 5 * std::sqrt(2.0 * chi2.degrees))
            << "roughness " << s.roughness << " metallic " << s.metallic;
    }
}

TEST(Sampling, WeightsOfTheBsdfIntegrateItsAlbedo) {
    Scene empty;
    const SurfaceReader reader(empty);
    const vec3 view = normalize(vec3(0.6f, 0, 0.8f));
    for (const Surface& s :
         {material(0, 1, 0, vec3(0.5f)), material(1, 0.4f, 1, vec3(1)), material(0, 0.5f, 1, vec3(0.7f))}) {
        double sampled = 0, integrated = 0;
        constexpr int n = 200000, side = 400;
        Rng rng(3, 1, 0);
        for (int i = 0; i < n; ++i)
            if (const auto scatter = sample_bsdf(reader, s, view, Carries::radiance, rng))
                sampled += double(scatter->weight.x) / n;
        for (int r = 0; r < side; ++r)
            for (int c = 0; c < side; ++c) {
                const vec3 d = direction_of((float(r) + 0.5f) / side, (float(c) + 0.5f) / side);
                integrated += double(reader.eval_brdf(s, s.normal, view, d, false).x * d.z) * 2 * M_PI / (side * side);
            }
        EXPECT_NEAR(sampled / integrated, 1, 0.01) << "roughness " << s.roughness;
    }
}

TEST(Sampling, SobolStratifiesEveryPrefixOfPowersOfTwo) {
    for (int d = 0; d < 5; ++d) {
        std::array<int, 64> hits{};
        for (uint32_t i = 0; i < 64; ++i) ++hits[size_t(sobol_owen(i, d, 5) * 64)];
        for (int h : hits) EXPECT_EQ(h, 1) << "dimension " << d;
    }
}

TEST(Sampling, EmittedDirectionsOfASpotFollowItsFalloff) {
    Scene scene;
    Light spot{};
    spot.type = light_spot;
    spot.direction = vec3(0, 0, -1);
    spot.cos_inner = 0.9f, spot.cos_outer = 0.7f;
    spot.intensity = vec3(1);
    scene.lights = {spot};
    const Emitters emitters(scene);
    double inner = 0;
    constexpr int n = 100000;
    for (uint32_t i = 0; i < n; ++i) {
        const Emission e = emitters.emit(0, {0, 0, (float(i) + 0.5f) / n, 0.25f, 0});
        EXPECT_GE(-e.direction.z, 0.7f - 1e-5f);
        inner += -e.direction.z > 0.9f;
    }
    EXPECT_NEAR(inner / n, 0.1 / (0.1 + 0.2 / 3), 1e-3);
    double flux = 0;  // numerical integral of the KHR falloff
    for (int i = 0; i < n; ++i) {
        const double c = 0.7 + 0.3 * (i + 0.5) / n, t = std::min((c - 0.7) / 0.2, 1.0);
        flux += 2 * M_PI * t * t * 0.3 / n;
    }
    EXPECT_NEAR(double(emitters.unit_flux(0)), flux, 1e-4 * flux);
}

double mean_lux(const PathTracer& tracer, vec3 point, vec3 normal, int samples, double& error) {
    double sum = 0, sum2 = 0;
    for (int i = 0; i < samples; ++i) {
        Rng rng(1, 9, uint64_t(i));
        const double lux = double(tracer.irradiance(point, normal, rng).y);
        sum += lux, sum2 += lux * lux;
    }
    const double mean = sum / samples;
    error = std::sqrt(std::max(0.0, sum2 / samples - mean * mean) / samples);
    return mean;
}

TEST(PathTracer, ClosedSphereHasTheIlluminanceOfTheIntegratingSphere) {
    const Scene scene = load_gltf(file_in_data("sphere.gltf"));
    const RayCaster caster(scene);
    const PathTracer tracer(scene, caster, lamp_powers(scene, {}));
    double error = 0;
    const double lux = mean_lux(tracer, vec3(0, -0.995f, 0), vec3(0, 1, 0), 20000, error);
    EXPECT_NEAR(lux, 100 / (1 - 0.5), 0.01 * 200 + 4 * error);  // E = (I / R^2) / (1 - rho), R = 1 m
}

TEST(PathTracer, FurnaceShowsTheSameRadianceEverywhere) {
    const Scene scene = load_gltf(file_in_data("furnace.gltf"));
    const RayCaster caster(scene);
    const PathTracer tracer(scene, caster, lamp_powers(scene, {}));
    double sum = 0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
        Rng rng(1, 2, uint64_t(i));
        sum +=
            double(tracer.radiance(scene.cameras[0].position, direction_of(1 - 2 * rng.next(), rng.next()), rng).y) / n;
    }
    EXPECT_NEAR(sum, 2.0, 0.02);  // L = Le / (1 - rho)
}

}  // namespace
}  // namespace lw
