// Coloured light: filters and colour temperatures of lamps on coloured walls, against the path tracer.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "benchmark/lab_scene.h"
#include "maps/bake.h"
#include "measure/survey.h"
#include "scene/ambiance.h"
#include "scene/lamp_factors.h"

namespace lw {
namespace {

const vec3 luminance_of_channels(0.2126f, 0.7152f, 0.0722f);

/// A red and a blue wall, a panel and a point lamp that shines on the red one.
Scene coloured_room() {
    LabScene lab;
    lab.add_room({0, 0, 0}, {4, 2.5f, 3}, 0.7f);
    lab.add_point({0.6f, 1.2f, 1.5f}, 200);
    lab.add_rectangle("panel", {2.5f, 2.4f, 1}, {0.5f, 0, 0}, {0, 0, 0.5f}, 0, 2000);
    Scene scene = lab.finish();
    for (size_t m = 0; m < scene.materials.size(); ++m) {
        if (scene.material_names[m] == "west") scene.materials[m].base_color = vec3(0.8f, 0.08f, 0.05f);
        if (scene.material_names[m] == "east") scene.materials[m].base_color = vec3(0.05f, 0.1f, 0.7f);
    }
    return scene;
}

std::vector<Sensor> sensors_in(const Scene& scene) {
    std::vector<Sensor> sensors;
    for (const float x : {1.2f, 2.0f, 2.8f, 3.6f})
        for (const vec3 normal : {vec3(0, -1, 0), vec3(-1, 0, 0), vec3(0, 0, 1)})
            sensors.push_back({vec3(x, 0.8f, 1.1f), normal, Response::planar});
    sensors.push_back({vec3(3, 1.2f, 2), {0, 1, 0}, Response::cylindrical});
    EXPECT_EQ(scene.lights.size(), 2u);
    return sensors;
}

Survey survey_of(const Scene& scene, const RayCaster& caster, std::vector<AmbianceFactors> ambiances) {
    constexpr uint64_t photons = 150'000;
    const PhotonMap map = bake(scene, caster, {.photons = photons});
    return make_survey(scene, caster, map, {{SensorSet::Kind::points, "points", "", sensors_in(scene), {}, {}}},
                       std::move(ambiances), {});
}

TEST(Color, FilteredLampsOnColouredWallsAgreeWithThePathTracer) {
    const Scene scene = coloured_room();
    const RayCaster caster(scene);
    const std::vector<vec3> factors = {vec3(1, 0.15f, 0.05f), vec3(0)};
    Survey survey = survey_of(scene, caster, {{"red", factors}, {"white", {vec3(1), vec3(0)}}});
    trace_survey(scene, caster, 15'000, 1, survey);
    const Agreement agreement = agreement_of(survey.sets[0], survey.ambiances[0], 1);
    EXPECT_GE(agreement.compared, 9u);
    EXPECT_GE(agreement.inside + 2, agreement.compared);
    EXPECT_LT(std::abs(agreement.difference), 0.01);
    // Light from the red wall keeps more of the red: a factor of the luminance alone would not do.
    const double alike = double(dot(factors[0], luminance_of_channels));
    const double red = values_of(survey.sets[0], survey.ambiances[0], 1)[1].lux,
                 white = values_of(survey.sets[0], survey.ambiances[1], 1)[1].lux;
    EXPECT_GT(std::abs(red / (white * alike) - 1), 0.1);
}

TEST(Color, ATemperatureKeepsTheLampsOwnLightAndTintsWhatIsReflected) {
    const Scene scene = coloured_room();
    const RayCaster caster(scene);
    const std::vector<vec3> warm = parse_factors(scene, {"panel=0.5@2700K"}),
                            plain = parse_factors(scene, {"panel=0.5"});
    Survey survey = survey_of(scene, caster, {{"warm", warm}, {"plain", plain}});
    trace_survey(scene, caster, 15'000, 1, survey);
    const Agreement agreement = agreement_of(survey.sets[0], survey.ambiances[0], 1);
    EXPECT_GE(agreement.inside + 2, agreement.compared);
    EXPECT_LT(std::abs(agreement.difference), 0.01);
    const size_t panel = scene.light_names[0] == "panel" ? 0 : 1;
    EXPECT_NEAR(double(dot(warm[panel], luminance_of_channels)), 0.5, 1e-4);
    EXPECT_GT(warm[panel].x, 2 * warm[panel].z);
    const std::vector<Value> of_warm = values_of(survey.sets[0], survey.ambiances[0], 1),
                             of_plain = values_of(survey.sets[0], survey.ambiances[1], 1);
    EXPECT_GT(of_warm[1].lux, 1.005 * of_plain[1].lux);  // by way of the red wall
}

TEST(Color, BadTemperaturesNameTheLamp) {
    const Scene scene = coloured_room();
    const auto error_of = [&](const std::string& text) -> std::string {
        try {
            parse_factors(scene, {text});
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_EQ(error_of("panel=1@2700"), "");
    EXPECT_NE(error_of("panel=1@270").find("--power panel=1@270: the colour temperature"), std::string::npos);
    EXPECT_NE(error_of("panel=1@warm").find("colour temperature"), std::string::npos);
    EXPECT_NE(error_of("panel=@2700").find("the factor"), std::string::npos);
    Scene blue = scene;
    blue.lights[0].intensity = vec3(0, 0, 100);
    EXPECT_THROW(parse_factors(blue, {blue.light_names[0] + "=1@2700"}), Error);
    EXPECT_THROW(lamp_factors(blue, {{blue.light_names[0], {1, vec3(1), 2700}}}), Error);
    EXPECT_EQ(lamp_factors(scene, {{"panel", {0.5f, vec3(1), 2700}}}), parse_factors(scene, {"panel=0.5@2700"}));
}

}  // namespace
}  // namespace lw
