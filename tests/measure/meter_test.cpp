// Sensors: powers stay live, walls do not leak, the same at any thread count, an error that is asked for is reached.
#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "maps/bake.h"
#include "measure/survey.h"
#include "measure/table.h"
#include "measure/two_chambers.h"

namespace lw {
namespace {

Survey survey_of(const Scene& scene, std::vector<SensorSet> sets, std::vector<AmbianceFactors> ambiances) {
    const RayCaster caster(scene);
    const PhotonMap map = bake(scene, caster, {.photons = 50'000});
    return make_survey(scene, caster, map, std::move(sets), std::move(ambiances), {});
}

SensorSet points(std::vector<Sensor> sensors) {
    return {SensorSet::Kind::points, "points", "", std::move(sensors), {}, {}};
}

TEST(Meter, LightDoesNotPassAWallWithoutThickness) {
    const Scene scene = test::two_chambers();
    std::vector<Sensor> east;
    for (const float x : {2.0f, 2.0005f, 2.001f, 2.01f, 3.0f}) east.push_back({{x, 1, 1}, {1, 0, 0}, Response::planar});
    east.push_back({{2, 0, 0}, {1, 0, 0}, Response::planar});  // in a corner of three surfaces
    east.push_back({{3, 0, 1}, {0, 1, 0}, Response::planar});
    const Survey survey = survey_of(scene, {points(east)}, {{"all", {vec3(1), vec3(1)}}});
    for (const Value& value : values_of(survey.sets[0], survey.ambiances[0], 1))
        EXPECT_LT(value.lux, 1e-3);  // the other side has more than 100 lx
}

TEST(Meter, SensorsOnSurfacesAndInCornersSeeTheirSide) {
    const Scene scene = test::two_chambers();
    const Survey survey = survey_of(scene,
                                    {points({{{2, 1, 1}, {-1, 0, 0}, Response::planar},
                                             {{1.999f, 1, 1}, {-1, 0, 0}, Response::planar},
                                             {{0, 0, 0}, {0, 1, 0}, Response::planar},
                                             {{0.002f, 0.001f, 0.002f}, {0, 1, 0}, Response::planar}})},
                                    {{"all", {vec3(1), vec3(0)}}});
    const std::vector<Value> v = values_of(survey.sets[0], survey.ambiances[0], 1);
    EXPECT_GT(v[0].lux, 100);  // the direct light alone is 100 lx
    EXPECT_NEAR(v[0].lux / v[1].lux, 1, 0.05);
    EXPECT_GT(v[2].lux, 100 / std::pow(3.0, 1.5));
    EXPECT_NEAR(v[2].lux / v[3].lux, 1, 0.05);
}

TEST(Meter, ValuesAreLinearInThePowers) {
    const Scene scene = test::two_chambers();
    const Survey survey =
        survey_of(scene, {points({{{1, 0.7f, 1.5f}, {0, 1, 0}, Response::planar}})},
                  {{"point", {vec3(1), vec3(0)}}, {"panel", {vec3(0), vec3(1)}}, {"both", {vec3(0.25f), vec3(3)}}});
    double lux[3];
    for (size_t a = 0; a < 3; ++a) lux[a] = values_of(survey.sets[0], survey.ambiances[a], 1)[0].lux;
    EXPECT_NEAR(lux[2], 0.25 * lux[0] + 3 * lux[1], 1e-4 * lux[2]);
    EXPECT_NEAR(values_of(survey.sets[0], survey.ambiances[2], 0.8f)[0].lux, 0.8 * lux[2], 1e-4 * lux[2]);
}

TEST(Meter, ReadsTheSameAtAnyThreadCount) {
    const Scene scene = test::two_chambers();
    std::vector<Sensor> sensors;
    for (int i = 0; i < 20; ++i) sensors.push_back({{0.1f + 0.09f * float(i), 0.8f, 1}, {0, 1, 0}, Response::planar});
    std::vector<std::string> tables;
    for (const unsigned threads : {1u, 2u}) {
        const ThreadLimit limit(threads);
        tables.push_back(sensors_as_csv(survey_of(scene, {points(sensors)}, {{"all", {vec3(1), vec3(1)}}}), scene));
    }
    EXPECT_EQ(tables[0], tables[1]);
}

TEST(Meter, AnErrorAskedForIsReachedByBakingAgain) {
    const Scene scene = test::two_chambers();
    const RayCaster caster(scene);
    const PhotonMap map = bake(scene, caster, {.photons = 2000});
    SurveySettings settings;
    settings.error = 0.02;
    const Survey survey = make_survey(scene, caster, map, {points({{{1, 0.7f, 1.5f}, {0, -1, 0}, Response::planar}})},
                                      {{"all", {vec3(1), vec3(1)}}}, settings);
    EXPECT_GT(survey.bakes, 0u);
    EXPECT_GT(survey.map.stored_photons, map.stored_photons);
    EXPECT_LE(values_of(survey.sets[0], survey.ambiances[0], 1)[0].relative(), 0.02);
    EXPECT_EQ(survey.unreached, 0u);
    settings.max_photons = 4000;
    const Survey bounded = make_survey(scene, caster, map, {points({{{1, 0.7f, 1.5f}, {0, -1, 0}, Response::planar}})},
                                       {{"all", {vec3(1), vec3(1)}}}, settings);
    EXPECT_EQ(bounded.unreached, 1u);
    EXPECT_FALSE(bounded.warnings.empty());
}

TEST(Meter, TooFewPhotonsAreDoubted) {
    const Scene scene = test::two_chambers();
    const RayCaster caster(scene);
    const PhotonMap map = bake(scene, caster, {.photons = 60});
    const Survey survey = make_survey(scene, caster, map, {points({{{1, 0.7f, 1.5f}, {0, -1, 0}, Response::planar}})},
                                      {{"all", {vec3(1), vec3(1)}}}, {});
    EXPECT_FALSE(values_of(survey.sets[0], survey.ambiances[0], 1)[0].doubt.empty());
}

}  // namespace
}  // namespace lw
