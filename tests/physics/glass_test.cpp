// Rooms with glass against closed forms: furnaces, by the path tracer and as a view shows them, Beer-Lambert, alpha.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "maps/bake.h"
#include "maps/estimate.h"
#include "scene/gltf.h"
#include "trace/bsdf.h"
#include "trace/build_bvh.h"
#include "trace/caustics.h"
#include "trace/path_tracer.h"
#include "trace/sampling.h"

namespace lw {
namespace {

std::string file_in_data(const std::string& name) { return std::string(LUMENWALK_SOURCE_DIR "/data/") + name; }

/// The furnace of known radiance with a ball or a sheet of another material in it.
Scene furnace_with(const Scene& thing, uint material_index, const std::function<void(Material&)>& change) {
    Scene scene = load_gltf(file_in_data("furnace.gltf"));
    const auto first_vertex = uint(scene.positions.size());
    Material m = thing.materials[material_index];
    change(m);
    scene.materials.push_back(m);
    scene.objects.push_back({uint(scene.materials.size() - 1), -1});
    for (size_t t = 0; t < thing.triangles.size(); ++t) {
        if (thing.objects[thing.triangle_objects[t]].material != material_index) continue;
        scene.triangles.push_back(thing.triangles[t] + first_vertex);
        scene.triangle_objects.push_back(uint(scene.objects.size() - 1));
    }
    for (vec3 p : thing.positions) scene.positions.push_back(p + vec3(thing.origin - scene.origin) - vec3(0, 0.6f, 0));
    for (vec3 n : thing.normals) scene.normals.push_back(n);
    return scene;
}

uint material_named(const Scene& scene, const std::string& name) {
    for (uint i = 0; i < scene.material_names.size(); ++i)
        if (scene.material_names[i] == name) return i;
    ADD_FAILURE() << "no material " << name;
    return 0;
}

double mean_radiance(const Scene& scene, vec3 eye, vec3 towards, double& error, int samples = 20000) {
    const RayCaster caster(scene);
    const PathTracer tracer(scene, caster, lamp_powers(scene, {}));
    double sum = 0, sum2 = 0;
    const mat3 frame = frame_around(normalize(towards - eye));
    for (int i = 0; i < samples; ++i) {
        Rng rng(1, 2, uint64_t(i));
        const vec3 direction = frame * direction_of(1 - 0.01f * rng.next(), rng.next());
        const double l = double(tracer.radiance(eye, direction, rng).y);
        sum += l, sum2 += l * l;
    }
    error = std::sqrt(std::max(0.0, sum2 / samples - sum * sum / samples / samples) / samples);
    return sum / samples;
}

TEST(Glass, AClearBallOrSheetIsInvisibleInAFurnace) {
    const Scene thing = load_gltf(file_in_data("glass_sphere.gltf"));
    const uint solid = material_named(thing, "solid");
    const auto clear = [](Material& m) { m.absorption = vec3(0); };
    const auto thin = [](Material& m) { m.absorption = vec3(0), m.flags |= material_thin; };
    for (const Scene& scene : {furnace_with(thing, solid, clear), furnace_with(thing, solid, thin)}) {
        double error = 0;
        const vec3 eye = scene.cameras[0].position, ball = scene.bounds[0] * 0.0f + vec3(0, -0.15f, 0);
        const double l = mean_radiance(scene, eye, ball, error);
        EXPECT_NEAR(l, 2, 0.005 + 4 * error);
        EXPECT_LT(error, 0.02);
    }
}

/// What a view of the ball shows: by photons, light samples and followed paths, in place of the path tracer.
double mean_viewed_radiance(const PhotonEstimator& estimator, const RayCaster& caster, vec3 eye, vec3 towards) {
    double sum = 0;
    constexpr uint side = 64;
    const mat3 frame = frame_around(normalize(towards - eye));
    for (uint i = 0; i < side * side; ++i) {
        Rng rng(1, 3, i);
        const vec3 direction = frame * direction_of(1 - 0.01f * rng.next(), rng.next());
        const auto hit = caster.nearest(eye, direction);
        if (!hit) {
            ADD_FAILURE() << "the furnace is not closed";
            return 0;
        }
        const uvec2 pixel(i % side, i / side);
        sum += double(estimator.shade(hit->triangle, hit->barycentrics, eye, 1 + i, pixel).radiance.y);
    }
    return sum / (side * side);
}

TEST(Glass, AViewOfAFurnaceShowsItsRadianceWhateverStandsInIt) {
    const Scene thing = load_gltf(file_in_data("glass_sphere.gltf"));
    const uint solid = material_named(thing, "solid");
    struct Case {
        const char* name;
        std::function<void(Material&)> change;
    };
    const auto mirror = [](Material& m) { m.transmission = 0, m.metallic = 1, m.base_color = vec3(1); };
    const Case cases[] = {
        {"clear ball", [](Material& m) { m.absorption = vec3(0); }},
        {"sheet", [](Material& m) { m.absorption = vec3(0), m.flags |= material_thin; }},
        {"mirror", mirror},
        {"narrow lobe", [&](Material& m) { mirror(m), m.roughness = 0.2f; }},
        {"blend of a mirror", [&](Material& m) { mirror(m), m.flags |= material_alpha_blend, m.alpha = 0.4f; }},
        {"rough ball", [](Material& m) { m.absorption = vec3(0), m.roughness = 0.2f; }},
        {"white paint under varnish",
         [](Material& m) { m.transmission = 0, m.base_color = vec3(1), m.roughness = 0.1f; }},
    };
    for (const Case& c : cases) {
        const Scene scene = furnace_with(thing, solid, c.change);
        const vec3 eye = scene.cameras[0].position, ball(0, -0.15f, 0);
        double error = 0;
        const double truth = mean_radiance(scene, eye, ball, error);
        const RayCaster caster(scene);
        const PhotonMap map = bake(scene, caster, {.photons = 1'000'000});
        const Bvh bvh = build_bvh(scene);
        const std::vector<vec3> weights = lamp_powers(scene, {});
        for (uint mode : {gather_mode_cached, gather_mode_smooth}) {
            GatherSettings gather;
            gather.mode = mode;
            gather.shadow_rays = 16;  // the walls are the lamp
            const PhotonEstimator estimator(scene, map, weights, gather, bvh);
            EXPECT_NEAR(mean_viewed_radiance(estimator, caster, eye, ball) / truth, 1, 0.03) << c.name << " " << mode;
        }
        EXPECT_NEAR(truth, 2, 0.06) << c.name;
    }
}

TEST(Glass, AbsorptionFollowsTheLengthOfTheWay) {
    // Index 1: straight through; the middle of a ball of radius 0.25 m is 0.5 m thick, a sheet of albedo 1 is black
    // there.
    const Scene thing = load_gltf(file_in_data("glass_sphere.gltf"));
    const Scene scene = furnace_with(thing, material_named(thing, "solid"), [](Material& m) {
        m.ior = 1, m.specular = 0;
        m.absorption = vec3(3);
    });
    const RayCaster caster(scene);
    const PathTracer tracer(scene, caster, lamp_powers(scene, {}));
    const vec3 centre(0, -0.15f, 0), eye = centre + vec3(0, 0, 0.8f);
    double sum = 0;
    constexpr int samples = 20000;
    for (int i = 0; i < samples; ++i) {
        Rng rng(1, 2, uint64_t(i));
        sum += double(tracer.radiance(eye, vec3(0, 0, -1), rng).y) / samples;
    }
    EXPECT_GT(sum, 0.2);
    EXPECT_NEAR(sum / (2 * std::exp(-3 * 0.5)), 1, 0.12);  // the walls lose what the ball takes: a little below
}

TEST(Alpha, ABlendedBallIsMetByItsAlphaAndAMaskedHoleNotAtAll) {
    const Scene thing = load_gltf(file_in_data("glass_sphere.gltf"));
    const auto seen = [&](uint flags, float alpha) {
        const Scene scene = furnace_with(thing, material_named(thing, "solid"), [&](Material& m) {
            m.transmission = 0, m.base_color = vec3(0), m.specular = 0;
            m.flags = flags, m.alpha = alpha;
        });
        const RayCaster caster(scene);
        const PathTracer tracer(scene, caster, lamp_powers(scene, {}));
        double sum = 0;
        constexpr int samples = 20000;
        for (int i = 0; i < samples; ++i) {
            Rng rng(1, 2, uint64_t(i));
            sum += double(tracer.radiance(vec3(0, -0.15f, 0.8f), vec3(0, 0, -1), rng).y) / samples;
        }
        return sum;
    };
    EXPECT_NEAR(seen(material_alpha_blend, 0.3f) / (2 * 0.7 * 0.7), 1, 0.04);  // its front and its back
    EXPECT_NEAR(seen(material_alpha_blend, 0), 2, 0.02);
    EXPECT_NEAR(seen(material_alpha_mask, 0.3f), 2, 0.02);
    EXPECT_EQ(seen(material_alpha_mask, 0.7f), 0);
}

}  // namespace
}  // namespace lw
