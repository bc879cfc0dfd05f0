// Each type of light against closed forms: emission, flux, light that arrives, pdf, radiance seen, and its traits.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "base/random.h"
#include "trace/emitter.h"
#include "trace/one_light.h"

namespace lw::test {
namespace {

constexpr int samples = 200'000;

Emission emission(const Emitters& emitters, uint64_t i) {
    Rng rng(5, 1, i);
    std::array<float, 5> u;
    for (float& number : u) number = rng.next();
    return emitters.emit(0, u);
}

TEST(Lights, EveryTypeIsTested) {
    for (const LightType type : all_types()) EXPECT_STRNE(unit_of(type), "") << type;
    EXPECT_STREQ(unit_of(LightType(light_type_count)), "") << "light_type_count is too small";
}

TEST(Lights, EmittedFluxFollowsTheIntensity) {
    for (const LightType type : all_types()) {
        if (comes_from_outside(type)) continue;  // one direction
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        Bins bins(DirectionBins::rows * DirectionBins::columns);
        for (int i = 0; i < samples; ++i) {
            const Emission e = emission(emitters, uint64_t(i));
            ASSERT_NEAR(length(e.direction), 1, 1e-4f);
            bins.count(DirectionBins::bin(e.direction), double(e.flux.y) / samples);
        }
        DirectionBins::for_all([&](vec3 direction, double solid_angle) {
            bins.expect(DirectionBins::bin(direction), intensity_of(type, direction) * solid_angle);
        });
        bins.check(std::string("directions, type ") + std::to_string(type));
    }
}

TEST(Lights, PhotonsStartWhereTheLightIs) {
    constexpr int side = 10;
    for (const LightType type : all_types()) {
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        const float radius = 0.5f * length(bounds[1] - bounds[0]);
        Bins bins(side * side);
        for (int i = 0; i < samples; ++i) {
            const Emission e = emission(emitters, uint64_t(i));
            if (comes_from_outside(type)) {
                ASSERT_EQ(e.direction, aim);
                ASSERT_GT(dot(e.origin, -aim), radius);
            } else {
                ASSERT_FLOAT_EQ(e.origin.z, place.z);
            }
            const std::optional<vec2> at = start_of(type, e.origin);
            ASSERT_EQ(at.has_value(), !is_at_point(type));
            if (!at) {
                ASSERT_EQ(e.origin, place);
                continue;
            }
            ASSERT_TRUE(at->x > -1e-4f && at->x < 1 + 1e-4f && at->y > -1e-4f && at->y < 1 + 1e-4f);
            const ivec2 cell = clamp(ivec2(*at * float(side)), ivec2(0), ivec2(side - 1));
            bins.count(size_t(side * cell.y + cell.x), 1.0 / samples);
        }
        for (size_t i = 0; i < side * side; ++i) bins.expect(i, 1.0 / (side * side));
        if (!is_at_point(type)) bins.check("places, type " + std::to_string(type));
    }
}

TEST(Lights, FluxIsTheIntegralOfTheIntensity) {
    for (const LightType type : all_types()) {
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        double flux = 0, emitted = 0;
        DirectionBins::for_all([&](vec3 direction, double angle) { flux += intensity_of(type, direction) * angle; });
        if (comes_from_outside(type)) flux = pi * std::pow(0.5 * double(length(bounds[1] - bounds[0])), 2);
        for (int i = 0; i < samples; ++i) emitted += double(emission(emitters, uint64_t(i)).flux.y) / samples;
        EXPECT_NEAR(double(emitters.unit_flux(0)) / flux, 1, 0.003) << type;
        EXPECT_NEAR(double(unit_flux(scene, scene.lights[0])) / flux, 1, 0.003) << type;
        EXPECT_NEAR(emitted / flux, 1, 0.005) << type;
    }
}

TEST(Lights, SamplesThatArriveGiveTheIrradianceOfTheClosedForm) {
    constexpr int side = 200;
    const vec3 normal(0, 0, 1);
    for (const LightType type : all_types()) {
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        const LightReader text(scene);
        for (const vec3 point : {vec3(0.2f, -0.1f, 1), vec3(0, 0, 0), vec3(0.9f, 0.3f, 0.7f), vec3(-1, -1.2f, 0.5f)}) {
            double arriving = 0, shaded = 0;
            for (int i = 0; i < side * side; ++i) {
                const vec2 u((float(i % side) + 0.5f) / side, (float(i / side) + 0.5f) / side);
                if (const auto in = emitters.arrive(0, point, u.x, u.y))
                    arriving += double(in->radiance.y * dot(in->to_light, normal)) /
                                (in->pdf > 0 ? double(in->pdf) : 1.0) / (side * side);
                const LightSample sample = text.sample_light(scene.lights[0], point, u);
                shaded += double(sample.irradiance.y * dot(sample.to_light, normal)) / (side * side);
            }
            const double expected = irradiance_of(type, point, normal);
            EXPECT_NEAR(arriving, expected, 2e-3 * expected + 1e-6) << type << " at " << point.x;
            EXPECT_NEAR(shaded, expected, 2e-3 * expected + 1e-6) << type << " at " << point.x;
        }
    }
}

TEST(Lights, DirectionsOfSamplesThatArriveFollowTheirPdf) {
    const vec3 point(0.1f, 0, 1.8f);  // close: the light fills many bins
    for (const LightType type : all_types()) {
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        if (is_delta(type)) {
            const auto first = emitters.arrive(0, point, 0.1f, 0.2f), second = emitters.arrive(0, point, 0.8f, 0.7f);
            ASSERT_TRUE(first && second) << type;
            EXPECT_EQ(first->to_light, second->to_light) << type;
            EXPECT_EQ(first->pdf, 0) << type;
            continue;
        }
        Bins bins(DirectionBins::rows * DirectionBins::columns);
        for (int i = 0; i < samples; ++i) {
            Rng rng(5, 2, uint64_t(i));
            const float u = rng.next(), v = rng.next();
            const auto in = emitters.arrive(0, point, u, v);
            ASSERT_TRUE(in);
            bins.count(DirectionBins::bin(in->to_light), 1.0 / samples);
        }
        double integral = 0;
        Surface there{};
        there.geometric_normal = aim;
        DirectionBins::for_all([&](vec3 direction, double solid_angle) {
            const float distance = (place.z - point.z) / direction.z;
            const vec3 offset = point + direction * distance - place;
            if (distance <= 0 || !covers(type, offset)) return;
            const double pdf = double(emitters.arrive_pdf(there, distance, direction));
            integral += pdf * solid_angle;
            bins.expect(DirectionBins::bin(direction), pdf * solid_angle);
        });
        EXPECT_NEAR(integral, 1, 0.01) << type;
        bins.check("arriving, type " + std::to_string(type));
    }
}

TEST(Lights, SurfacesShowTheirRadianceToTheirFrontAlone) {
    for (const LightType type : all_types()) {
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        EXPECT_EQ(has_surface(type), !scene.emitters.empty()) << type;
        if (!has_surface(type)) continue;
        Surface s = SurfaceReader(scene).surface_at(0, vec2(0.3f));
        EXPECT_EQ(s.light, 0);
        EXPECT_EQ(emitters.radiance(s, aim), vec3(1)) << type;
        EXPECT_EQ(emitters.radiance(s, -aim), vec3(0)) << type;
        s.flags |= material_double_sided;
        EXPECT_EQ(emitters.radiance(s, -aim), vec3(1)) << type;
        s.light = -1;
        EXPECT_EQ(emitters.radiance(s, aim), vec3(0)) << type;
    }
}

TEST(Lights, TraitsTellWhatSamplesDo) {
    for (const LightType type : all_types()) {
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        const vec3 point(0, 0, 1);
        const auto in = emitters.arrive(0, point, 0.3f, 0.6f);
        ASSERT_TRUE(in) << type;
        EXPECT_EQ(is_delta(type), in->pdf == 0) << type;
        EXPECT_EQ(is_at_point(type), in->position == place) << type;
        const float radius = 0.5f * length(bounds[1] - bounds[0]);
        EXPECT_EQ(comes_from_outside(type), length(in->position) > radius) << type;
        EXPECT_EQ(has_table(type), !scene.texels.empty()) << type;
    }
}

TEST(Lights, CellsHoldLightThatIsLinearNearby) {
    constexpr float step = 0.05f;  // 40 steps from the light: the curvature of 1 / d^2 is below 1 %
    for (const LightType type : all_types()) {
        if (!is_linear_in_cells(type)) continue;
        EXPECT_TRUE(is_delta(type)) << type;
        const Scene scene = scene_with(type);
        const Emitters emitters(scene);
        const auto lux = [&](vec3 p) {
            const auto in = emitters.arrive(0, p, 0, 0);
            return in ? double(in->radiance.x * in->to_light.z) : 0.0;
        };
        int held = 0;
        for (float x = -1.5f; x < 1.5f; x += step) {
            const vec3 a(x, 0, 0), b(x + step, 0, 0), middle(x + step / 2, 0, 0);
            if (!is_fully_lit(scene.lights[0], a) || !is_fully_lit(scene.lights[0], b)) continue;
            EXPECT_NEAR((lux(a) + lux(b)) / 2 / lux(middle), 1, 0.01) << type << " " << x;
            ++held;
        }
        EXPECT_GT(held, 10) << type;
    }
}

}  // namespace
}  // namespace lw::test
