// What a report states of a field, by hand: Emin, Eavg, Emax, U0, Ud with their intervals, cylindrical illuminance,
// means of walls and ceilings, tasks, borders.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "benchmark/lab_scene.h"
#include "maps/bake.h"
#include "measure/grid.h"
#include "measure/survey.h"

namespace lw {
namespace {

constexpr double pi = 3.14159265358979323846;

Value value(double lux, double ray_error, double photon_error, const std::string& doubt = "") {
    return {lux, std::hypot(1.895 * ray_error, 1.645 * photon_error), ray_error, photon_error, 1000, doubt};
}

TEST(Sums, OfAFieldByHand) {
    std::vector<Reading> readings(5);
    readings[4].blocked = true;
    const std::vector<Value> values = {value(400, 4, 2), value(500, 3, 2), value(600, 6, 4, "too few photons"),
                                       value(300, 0, 4), value(7, 0, 0)};
    const Statistics s = statistics_of(readings, values);
    EXPECT_EQ(s.count, 4u);
    EXPECT_EQ(s.blocked, 1u);
    EXPECT_EQ(s.doubtful, 1u);
    EXPECT_EQ(s.minimum.value, 300);
    EXPECT_EQ(s.maximum.value, 600);
    EXPECT_EQ(s.average.value, 450);
    EXPECT_NEAR(s.minimum.half_width, 1.645 * 4, 1e-9);
    // Rays err apart, photons together: sqrt(16 + 9 + 36) / 4 and (2 + 2 + 4 + 4) / 4.
    EXPECT_NEAR(s.average.half_width, 1.645 * std::hypot(std::sqrt(61.0) / 4, 3.0), 1e-9);
    EXPECT_NEAR(s.u0.value, 300.0 / 450, 1e-12);
    EXPECT_NEAR(s.ud.value, 0.5, 1e-12);
    EXPECT_NEAR(s.ud.half_width, 0.5 * std::hypot(s.minimum.half_width / 300, s.maximum.half_width / 600), 1e-12);
    // Four samples of a surface: their spread is sqrt(12500) lx, of the mean half of it.
    const Statistics sampled = statistics_of(readings, values, true);
    EXPECT_NEAR(sampled.average.half_width, 1.645 * std::sqrt(61.0 / 16 + 12500.0 / 4 + 9), 1e-9);
    EXPECT_EQ(statistics_of(std::span(readings).last(1), std::span(values).last(1)).count, 0u);
}

TEST(Sums, TasksAreThoseOfTheStandard) {
    const std::map<std::string, std::pair<double, double>> expected = {
        {"office", {500, 0.6}},     {"filing", {300, 0.4}},        {"drawing", {750, 0.7}},
        {"conference", {500, 0.6}}, {"reception", {300, 0.6}},     {"circulation", {100, 0.4}},
        {"stairs", {100, 0.4}},     {"classroom", {500, 0.6}},     {"wall", {50, 0.1}},
        {"ceiling", {30, 0.1}},     {"visual-contact", {150, 0.1}}};
    for (const auto& [name, required] : expected) {
        EXPECT_EQ(find_task(name).illuminance, required.first) << name;
        EXPECT_EQ(find_task(name).uniformity, required.second) << name;
    }
    for (const Task& task : known_tasks()) EXPECT_TRUE(task.edition == 2011 || task.edition == 2021) << task.name;
}

/// A black room with a lamp in its middle: what falls on a wall is known.
Scene black_room() {
    LabScene lab;
    lab.add_room({-2, -2, -2}, {2, 2, 2}, 0);
    lab.add_point({0, 0, 0}, 100);
    return lab.finish();
}

Survey measured(const Scene& scene, std::vector<SensorSet> sets) {
    const RayCaster caster(scene);
    const PhotonMap map = bake(scene, caster, {.photons = 20'000});
    return make_survey(scene, caster, map, std::move(sets), {{"all", std::vector<vec3>(scene.lights.size(), vec3(1))}},
                       {});
}

TEST(Sums, MeansOfWallsAndCeilingAreTheLampsSixthOverTheirArea) {
    const Scene scene = black_room();
    const Survey survey =
        measured(scene, {make_surface("ceiling: count=400 task=ceiling", scene), make_surface("west: count=400", scene),
                         make_grid(parse_grid("wall: -2,-2,-2 to -2,2,2 facing=+x spacing=0.2"), scene)});
    const double mean = 4 * pi * 100 / 6 / 16, corner = 100 * 2 / std::pow(12.0, 1.5);
    for (const MeasuredSet& set : survey.sets) {
        const Statistics s = statistics_of(set, survey.ambiances[0], 0.8f);
        EXPECT_NEAR(s.average.value, 0.8 * mean, 0.01 * mean) << set.set.name;
        EXPECT_GT(s.minimum.value, 0.8 * corner);
        EXPECT_LT(s.minimum.value, 0.8 * corner * 1.25);
        EXPECT_NEAR(s.maximum.value, 0.8 * 25, 0.3) << set.set.name;
        EXPECT_NEAR(s.ud.value, s.minimum.value / s.maximum.value, 1e-12);
    }
    EXPECT_EQ(judge(statistics_of(survey.sets[0], survey.ambiances[0], 1), find_task("ceiling")).both(), Verdict::fail);
}

TEST(Sums, CylindricalIlluminanceIsTheMeanOfAllVerticalPlanes) {
    const Scene scene = black_room();
    std::vector<Sensor> sensors = {{{1, 0.3f, 0.5f}, {0, 1, 0}, Response::cylindrical}};
    constexpr int planes = 72;
    for (int i = 0; i < planes; ++i) {
        const float turn = 2 * lw_pi * (float(i) + 0.5f) / planes;
        sensors.push_back({sensors[0].position, {std::cos(turn), 0, std::sin(turn)}, Response::planar});
    }
    const Survey survey = measured(scene, {{SensorSet::Kind::points, "p", "", sensors, {}, {}}});
    const std::vector<Value> values = values_of(survey.sets[0], survey.ambiances[0], 1);
    double mean = 0;
    for (size_t i = 1; i < values.size(); ++i) mean += values[i].lux / planes;
    const double d2 = 1.25 + 0.09, sine = std::sqrt(1.25 / d2);
    EXPECT_NEAR(values[0].lux, 100 / d2 * sine / pi, 1e-3 * values[0].lux);
    EXPECT_NEAR(values[0].lux, mean, 2e-3 * mean);
}

TEST(Borders, ValuesWithinACentimetreOfOneAreDoubted) {
    LabScene lab;
    lab.add_room({-2, -2, -2}, {2, 2, 2}, 0.5f);
    lab.add_rectangle("table", {0, -1, 0}, {0, 0, 1}, {1, 0, 0}, 0.5f);
    lab.add_point({0, 1, 0}, 100);
    const Scene scene = lab.finish();
    const vec3 up(0, 1, 0);
    const Survey survey = measured(scene, {{SensorSet::Kind::points,
                                            "p",
                                            "",
                                            {{{-1.993f, 0, 0}, up, Response::planar},
                                             {{-1.9f, 0, 0}, up, Response::planar},
                                             {{0.5f, -1, 0.005f}, up, Response::planar},
                                             {{0.5f, -1, 0.5f}, up, Response::planar},
                                             {{0.5f, -0.9f, 0.005f}, up, Response::planar},
                                             {{-2, 0, 0}, {1, 0, 0}, Response::planar}},
                                            {},
                                            {}}});
    const std::vector<Value> values = values_of(survey.sets[0], survey.ambiances[0], 1);
    const std::vector<bool> near_border = {true, false, true, false, false, false};
    for (size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(values[i].doubt == "within 1 cm of a border", near_border[i]) << i << ": " << values[i].doubt;
}

TEST(Borders, SensorsAtALampWithoutSizeAreDoubted) {
    LabScene lab;
    lab.add_room({-2, -2, -2}, {2, 2, 2}, 0.5f);
    lab.add_point({0, 1, 0}, 100);
    const vec3 up(0, 1, 0);
    const Survey survey = measured(lab.finish(), {{SensorSet::Kind::points,
                                                   "p",
                                                   "",
                                                   {{{0, 1, 0}, up, Response::planar},
                                                    {{0, 0.992f, 0}, up, Response::planar},
                                                    {{0, 1, 0}, up, Response::cylindrical},
                                                    {{0, 0.9f, 0}, up, Response::planar}},
                                                   {},
                                                   {}}});
    const std::vector<Value> values = values_of(survey.sets[0], survey.ambiances[0], 1);
    for (size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(values[i].doubt == "within 1 cm of a lamp without size", i < 3) << i << ": " << values[i].doubt;
}

TEST(Borders, SensorsInsideSolidObjectsAreLeftOut) {
    LabScene lab;
    lab.add_room({-2, -2, -2}, {2, 2, 2}, 0.5f);
    lab.add_point({0, 1, 0}, 100);
    // A pillar of 0.4 m from floor to ceiling, its faces outwards.
    lab.add_rectangle("pillar", {1, -2, -1}, {0, 4, 0}, {0.4f, 0, 0}, 0.5f);
    lab.add_rectangle("pillar", {1, -2, -0.6f}, {0.4f, 0, 0}, {0, 4, 0}, 0.5f);
    lab.add_rectangle("pillar", {1, -2, -1}, {0, 0, 0.4f}, {0, 4, 0}, 0.5f);
    lab.add_rectangle("pillar", {1.4f, -2, -1}, {0, 4, 0}, {0, 0, 0.4f}, 0.5f);
    lab.add_rectangle("pillar", {1, -2, -1}, {0.4f, 0, 0}, {0, 0, 0.4f}, 0.5f);
    lab.add_rectangle("pillar", {1, 2, -1}, {0, 0, 0.4f}, {0.4f, 0, 0}, 0.5f);
    const Scene scene = lab.finish();
    const Survey survey = measured(scene, {make_grid(parse_grid("plane: 0.8,0,-1 to 1.6,0,-0.6 spacing=0.2"), scene)});
    const Statistics s = statistics_of(survey.sets[0], survey.ambiances[0], 1);
    EXPECT_EQ(s.blocked, 4u);
    EXPECT_EQ(s.count, 4u);
    EXPECT_GT(s.minimum.value, 1);
}

}  // namespace
}  // namespace lw
