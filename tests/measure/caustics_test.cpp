// Sensors where glass focuses light: on surfaces and in the air, against the path tracer that traces caustics from the
// lamps.
#include <gtest/gtest.h>

#include <cmath>

#include "maps/bake.h"
#include "measure/survey.h"
#include "scene/gltf.h"
#include "trace/caustics.h"

namespace lw {
namespace {

TEST(Caustics, SensorsUnderAndAroundTheGlassBallAgreeWithThePathTracer) {
    const Scene scene = load_gltf(LUMENWALK_SOURCE_DIR "/data/glass_sphere.gltf");
    const RayCaster caster(scene);
    constexpr uint64_t photons = 300'000;
    const PhotonMap map = bake(scene, caster, {.photons = photons});
    ASSERT_GT(map.caustic_grids, 0u);
    std::vector<Sensor> on_floor, in_air, focus;
    for (int x = 0; x < 6; ++x)
        for (int z = 0; z < 6; ++z) {
            const vec3 at(-0.8f + 0.32f * float(x), -1, -0.8f + 0.32f * float(z));
            if (const auto hit = caster.nearest(at + vec3(0, 0.5f, 0), {0, -1, 0}); !hit || hit->distance < 0.49f)
                continue;
            on_floor.push_back({at, {0, 1, 0}, Response::planar});
            in_air.push_back({at + vec3(0, 1.6f, 0), {0, -1, 0}, Response::planar});
        }
    // Where the caustics lie: at every so many of the arrivals of their light on the floor.
    std::vector<vec3> weights = lamp_powers(scene, {});
    for (size_t i = 0; i < weights.size(); ++i)
        if (scene.lights[i].type == light_mesh) weights[i] = vec3(0);  // theirs are faint and wide
    const Caustics caustics(scene, caster, weights, {20'000, 0.01f, 1, 0});
    std::vector<vec3> lit;
    for (const Caustics::Arrival& arrival : caustics.arrivals())
        if (arrival.normal.y > 0.99f && arrival.position.y < -0.99f) lit.push_back(arrival.position);
    ASSERT_GT(lit.size(), 100u);
    for (size_t i = 0; i < 80; ++i) focus.push_back({lit[i * lit.size() / 80], {0, 1, 0}, Response::planar});
    const std::vector<vec3> full(scene.lights.size(), vec3(1));
    Survey survey = make_survey(scene, caster, map,
                                {{SensorSet::Kind::points, "focus", "", focus, {}, {}},
                                 {SensorSet::Kind::points, "floor", "", on_floor, {}, {}},
                                 {SensorSet::Kind::points, "air", "", in_air, {}, {}}},
                                {{"all", full}}, {});
    trace_survey(scene, caster, 5'000, 1, survey);
    for (const MeasuredSet& measured : survey.sets) {
        const Agreement a = agreement_of(measured, survey.ambiances[0], 1);
        std::printf("%s: %zu of %zu, %+.2f %%\n", measured.set.name.c_str(), a.inside, a.compared, 100 * a.difference);
        // Two standard deviations under 90 % of some thirty sensors. In the focus, light of a few millimetres, most
        // values say themselves that they are wide: 14 of 80 do not.
        const bool wide = measured.set.name == "focus";
        EXPECT_GE(a.compared, wide ? 10 : measured.set.sensors.size() / 2) << measured.set.name;
        EXPECT_GE(double(a.inside), 0.79 * double(a.compared)) << measured.set.name;
        EXPECT_LT(std::abs(a.difference), wide ? 0.1 : 0.02) << measured.set.name;
    }
    EXPECT_FALSE(survey.warnings.empty());  // of light that sensors in the air do not see arrive
}

}  // namespace
}  // namespace lw
