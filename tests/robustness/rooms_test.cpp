// The same room written down in hard ways has the same light: mean within 1 %, RMSE within twice the noise of two
// seeds. Prints the rows of the table in docs/robustness.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "gather/renderer.h"
#include "maps/build.h"
#include "maps/estimate.h"
#include "programs/lavapipe.h"
#include "robustness/room.h"
#include "trace/build_bvh.h"

namespace lw::test {
namespace {

constexpr uint modes[] = {gather_mode_cached, gather_mode_smooth, gather_mode_exact};
constexpr const char* mode_names[] = {"exact", "smooth", "cached"};

/// The name of a disguise as words.
std::string words_of(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

/// The plain room's readings of two seeds: what is expected, and the noise.
struct Expected {
    Readings readings;
    double noise;
};

const Expected& expected(uint mode) {
    static const std::map<uint, Expected> all = [] {
        const Room room = plain_room();
        const Baked first(room), second(room, 200'000, 2);
        std::map<uint, Expected> found;
        for (uint m : modes) {
            const Readings readings = read(first, room, m);
            found[m] = {readings, difference(readings, read(second, room, m)).rmse};
        }
        return found;
    }();
    return all.at(mode);
}

struct Disguise {
    const char* name;
    Room (*room)();
    double scale = 1;  // of the illuminance
};

void PrintTo(const Disguise& disguise, std::ostream* out) { *out << disguise.name; }

Room with_node(const glm::dmat4& node) {
    Room room = plain_room();
    room.node = node;
    return room;
}

Room with_soup(Soup (*change)(const Soup&)) {
    Room room = plain_room();
    for (Soup* soup : {&room.walls, &room.block}) *soup = change(*soup);
    return room;
}

Room far_in_vertices() {
    const glm::dvec3 far(10240, 0, -10240);
    Room room = plain_room();
    for (Soup* soup : {&room.walls, &room.block, &room.panel})
        *soup = moved(*soup, [=](glm::dvec3 p) { return p + far; });
    room.lamp += far, room.eye += far;
    return room;
}

/// Made smaller or larger in its vertices, under a node that undoes it or under none.
Room scaled_in_vertices(double scale, bool undone_by_node) {
    Room room = plain_room();
    for (Soup* soup : {&room.walls, &room.block, &room.panel})
        *soup = moved(*soup, [=](glm::dvec3 p) { return p * scale; });
    room.lamp *= scale, room.eye *= scale;
    room.unit = scale;
    if (undone_by_node)
        room.node = glm::scale(glm::dmat4(1), glm::dvec3(1 / scale));
    else
        room.candela *= scale * scale;
    return room;
}

/// Each quad of two triangles as strips whose sides are 1 : 10,000.
Soup needles(const Soup& soup) {
    Soup strips;
    for (size_t i = 0; i < soup.size(); i += 2) {
        const auto& [a, b, c] = soup[i];
        const glm::dvec3 u = b - a, v = c - b;
        strips = joined(strips, quad(a, u, v, 1, int(std::round(glm::length(v) / glm::length(u) * 10'000))));
    }
    return strips;
}

Soup flipped(const Soup& soup) {
    Soup other = soup;
    for (Corners& t : other) std::swap(t[1], t[2]);
    return other;
}

const Disguise disguises[] = {
    {"1000_km_away_by_its_node", [] { return with_node(glm::translate(glm::dmat4(1), glm::dvec3(1e6, -1e6, 1e6))); }},
    {"10_km_away_in_its_vertices", far_in_vertices},
    {"a_millimetre_wide_by_its_node",
     [] {
         Room room = with_node(glm::scale(glm::dmat4(1), glm::dvec3(0.25e-3)));
         room.candela *= 0.25e-3 * 0.25e-3;
         return room;
     }},
    {"a_kilometre_wide_by_its_node",
     [] {
         Room room = with_node(glm::scale(glm::dmat4(1), glm::dvec3(250)));
         room.candela *= 250.0 * 250.0;
         return room;
     }},
    {"a_millimetre_wide_in_its_vertices", [] { return scaled_in_vertices(0.25e-3, false); }},
    {"a_kilometre_wide_in_its_vertices", [] { return scaled_in_vertices(250, false); }},
    {"turned", [] { return with_node(glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(1, 2, 3) / std::sqrt(14.0))); }},
    {"mirrored", [] { return with_node(glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1))); }},
    {"a_million_triangles", [] { return with_soup([](const Soup& s) { return divided(s, 204); }); }},
    {"needles_of_1_to_10000", [] { return with_soup(needles); }},
    {"T_junctions",
     [] {
         return with_soup([](const Soup& s) {
             Soup mixed;
             for (size_t i = 0; i < s.size(); ++i) mixed = joined(mixed, divided({s[i]}, i % 2 ? 7 : 1 + int(i % 5)));
             return mixed;
         });
     }},
    {"every_triangle_twice", [] { return with_soup([](const Soup& s) { return joined(s, s); }); }},
    {"every_small_triangle_twice",
     [] { return with_soup([](const Soup& s) { return joined(divided(s, 30), divided(s, 30)); }); }},
    {"coplanar_overlapping",
     [] {
         Room room = plain_room();
         room.walls = joined(room.walls, quad({1, 0, 1}, {0, 0, 3}, {2.5, 0, 0}));
         return room;
     }},
    {"with_triangles_without_area",
     [] {
         return with_soup([](const Soup& s) {
             Soup more = s;
             for (const auto& [a, b, c] : s) {
                 more.push_back({a, a, b});
                 more.push_back({a, a, a});
                 more.push_back({a, (a + b) * 0.5, b});
             }
             return more;
         });
     }},
    {"denormal_coordinates",
     [] {
         return with_soup(
             [](const Soup& s) { return moved(s, [](glm::dvec3 p) { return glm::max(p, glm::dvec3(1e-41)); }); });
     }},
    {"of_denormal_coordinates_alone", [] { return scaled_in_vertices(1e-39, true); }},
    {"inside_out", [] { return with_soup(flipped); }},
    {"mixed_winding",
     [] {
         return with_soup([](const Soup& s) {
             Soup mixed = divided(s, 10);
             for (size_t i = 0; i < mixed.size(); i += 3) std::swap(mixed[i][1], mixed[i][2]);
             return mixed;
         });
     }},
    {"double_sided",
     [] {
         Room room = plain_room();
         room.double_sided = true;
         return room;
     }},
    {"lit_1e9_times",
     [] {
         Room room = plain_room();
         room.candela *= 1e9, room.panel_luminance *= 1e9;
         return room;
     },
     1e9},
    {"lit_1e_6_times",
     [] {
         Room room = plain_room();
         room.candela *= 1e-6, room.panel_luminance *= 1e-6;
         return room;
     },
     1e-6},
};

class Robustness : public testing::TestWithParam<Disguise> {};

INSTANTIATE_TEST_SUITE_P(Rooms, Robustness, testing::ValuesIn(disguises),
                         [](const auto& disguise) { return std::string(disguise.param.name); });

TEST_P(Robustness, TheRoomHasTheSameLight) {
    const Room room = GetParam().room();
    const Baked baked(room);
    for (uint mode : modes) {
        const Readings readings = read(baked, room, mode);
        for (double lux : readings.lux) ASSERT_TRUE(std::isfinite(lux));
        const Difference d = difference(expected(mode).readings, readings, GetParam().scale);
        char wanted[64];
        std::snprintf(wanted, sizeof wanted, "RMSE <= %.1f %%, bias <= 1 %%", 200 * expected(mode).noise);
        tell_case(words_of(GetParam().name) + ", " + mode_names[mode], wanted, "RMSE %.1f %%, bias %+.2f %%",
                  100 * d.rmse, 100 * (d.mean_ratio - 1));
        EXPECT_GT(d.compared, 550u) << mode_names[mode];
        EXPECT_NEAR(d.mean_ratio, 1, 0.01) << mode_names[mode];
        EXPECT_LE(d.rmse, 2 * expected(mode).noise) << mode_names[mode];
    }
}

TEST(RobustnessOfNodes, AShearedNodeIsTheShearOfItsVertices) {
    glm::dmat4 shear(1);
    shear[1][0] = 0.4, shear[2][1] = -0.3, shear[0][0] = -1;  // mirrored too
    const auto move = [&](glm::dvec3 p) { return glm::dvec3(shear * glm::dvec4(p, 1)); };
    const Room by_node = with_node(shear);
    Room by_vertices = plain_room();
    for (Soup* soup : {&by_vertices.walls, &by_vertices.block, &by_vertices.panel}) {
        *soup = moved(*soup, move);
        for (Corners& t : *soup) std::swap(t[1], t[2]);  // what the mirror turned over
    }
    by_vertices.lamp = move(by_vertices.lamp), by_vertices.eye = move(by_vertices.eye);
    const Baked a(by_node), b(by_vertices);
    ASSERT_EQ(a.scene.triangles.size(), b.scene.triangles.size());
    const double areas[] = {area_of(a.scene), area_of(b.scene)};
    EXPECT_NEAR(areas[0] / areas[1], 1, 1e-5);
    double sums[2] = {0, 0};
    for (const Photon& p : a.photons.records) sums[0] += double(p.flux.y);
    for (const Photon& p : b.photons.records) sums[1] += double(p.flux.y);
    tell_case("sheared and mirrored by its node", "flux of its vertices sheared, +-1 %", "%+.2f %%",
              100 * (sums[0] / sums[1] - 1));
    EXPECT_NEAR(sums[0] / sums[1], 1, 0.01);
    for (uint mode : modes) {  // by_node's rays, in the room that both are
        const Difference d = difference(read(a, by_node, mode), read(b, by_node, mode));
        EXPECT_GT(d.compared, 550u) << mode_names[mode];
        EXPECT_NEAR(d.mean_ratio, 1, 0.01) << mode_names[mode];
        EXPECT_LE(d.rmse, 2 * expected(mode).noise) << mode_names[mode];
    }
    EXPECT_NEAR(double(length(a.scene.lights[0].position - b.scene.lights[0].position)), 0, 1e-4);
    for (size_t v = 0; v < a.scene.positions.size(); ++v)
        ASSERT_NEAR(double(std::abs(dot(a.scene.normals[v], a.scene.normals[v]))), 1, 1e-4);
    for (uint t = 0; t < a.scene.triangles.size(); ++t) {
        const SurfaceReader first(a.scene), second(b.scene);
        EXPECT_GT(
            dot(first.surface_at(t, vec2(0.3f)).geometric_normal, second.surface_at(t, vec2(0.3f)).geometric_normal),
            0.999f)
            << t;
    }
}

double mean_of(const std::vector<float>& values) {
    double sum = 0;
    for (float v : values) sum += double(v);
    return sum / double(values.size());
}

Image picture_of(const Device& device, const Baked& baked, const Camera& camera) {
    const Bvh bvh = build_bvh(baked.scene);
    const Resident resident(device, baked.scene, baked.map, bvh);
    Renderer renderer(device, resident, 32, 24);
    RenderSettings settings;
    settings.exposure_ev = 0.0f;
    Camera near_camera = camera;
    near_camera.near = 1e-3f * baked.scene.size();  // metres in the file, also of a camera under a scaled node
    return renderer.render(near_camera, settings).image;
}

/// Illuminances of the room's picture, as of the plain room: over the scale, and that of a mirrored one turned over.
std::vector<float> illuminances_of(const Device& device, const Baked& baked, const Disguise& disguise) {
    const Image image = picture_of(device, baked, baked.scene.cameras[0]);
    std::vector<float> lux = image.find("illuminance")->values;
    for (float& e : lux) EXPECT_TRUE(std::isfinite(e) && e >= 0) << disguise.name;
    for (float& e : lux) e /= float(disguise.scale);
    if (std::string(disguise.name) == "mirrored")
        for (auto row = lux.begin(); row != lux.end(); row += image.width) std::reverse(row, row + image.width);
    return lux;
}

double rmse_of(const std::vector<float>& a, const std::vector<float>& b) {
    double squares = 0;
    for (size_t i = 0; i < a.size(); ++i) squares += std::pow(double(a[i]) - double(b[i]), 2);
    return std::sqrt(squares / double(a.size())) / mean_of(a);
}

/// Of those that change what the shaders compute with: places, sizes, sides, triangles that hardly have any. Each takes
/// seconds of making pipelines; that shaders and CPU estimate the same is the business of other tests.
constexpr const char* drawn[] = {"_away",   "wide_by", "mirrored", "inside_out",
                                 "mixed_w", "million", "needles",  "of_denormal"};

TEST(RobustnessOnADevice, TheRoomHasTheSamePicture) {
    SKIP_WITHOUT_LAVAPIPE();
    const Device device({"llvmpipe", true});
    const Disguise none{"none", plain_room};
    const std::vector<float> wanted = illuminances_of(device, Baked(plain_room()), none);
    const double noise = rmse_of(wanted, illuminances_of(device, Baked(plain_room(), 200'000, 2), none));
    char allowed[64];
    std::snprintf(allowed, sizeof allowed, "RMSE <= %.1f %%, bias <= 1 %%", 200 * noise);
    for (const Disguise& disguise : disguises) {
        const std::string name = disguise.name;
        const auto holds = [&](const char* part) { return name.find(part) != std::string::npos; };
        if (std::none_of(std::begin(drawn), std::end(drawn), holds)) continue;
        const std::vector<float> got = illuminances_of(device, Baked(disguise.room()), disguise);
        const double rmse = rmse_of(wanted, got), ratio = mean_of(got) / mean_of(wanted);
        tell_case(words_of(name) + ", picture on the device", allowed, "RMSE %.1f %%, bias %+.2f %%", 100 * rmse,
                  100 * (ratio - 1));
        EXPECT_NEAR(ratio, 1, 0.01) << name;
        EXPECT_LE(rmse, 2 * noise) << name;
    }
    EXPECT_EQ(device.validation_messages(), std::vector<std::string>{});
}

TEST(RobustnessOnADevice, AnyCameraShowsLightThatIsANumber) {
    SKIP_WITHOUT_LAVAPIPE();
    const Device device({"llvmpipe", true});
    const Baked baked(plain_room(), 20'000);
    const Bvh bvh = build_bvh(baked.scene);
    const Resident resident(device, baked.scene, baked.map, bvh);
    Renderer renderer(device, resident, 16, 12);
    const Camera eye = baked.scene.cameras[0];
    std::vector<float> middle;
    for (uint mode : modes)  // outermost: each has pipelines of its own
        for (float degrees : {1.0f, 60.0f, 170.0f})
            for (const vec3 moved_by : {vec3(0), vec3(0, 2, 0), vec3(0, -1.6f, 0), vec3(0.8f, 0, 0), vec3(50, 0, 0)}) {
                Camera camera = eye;
                camera.yfov = glm::radians(degrees);
                camera.position += moved_by;  // inside the ceiling, on the floor, on a wall, outside
                RenderSettings settings;
                settings.gather.mode = mode;
                settings.gather.neighbours = 20;
                const Image image = renderer.render(camera, settings).image;
                for (const char* channel : {"R", "G", "B", "illuminance"})
                    for (float v : image.find(channel)->values)
                        ASSERT_TRUE(std::isfinite(v) && v >= 0) << channel << " " << degrees << " " << mode;
                if (moved_by == vec3(0) && mode == gather_mode_cached)
                    middle.push_back(image.find("illuminance")->values[16 * 6 + 8]);
            }
    ASSERT_EQ(middle.size(), 3u);
    tell_case("fields of view of 1, 60 and 170 degrees; cameras in walls, on the floor, outside",
              "light in every pixel", "the middle reads %.1f, %.1f, %.1f lx", double(middle[0]), double(middle[1]),
              double(middle[2]));
    EXPECT_NEAR(middle[0] / middle[1], 1, 0.05);
    EXPECT_NEAR(std::log2(middle[2] / middle[1]), 0, 1);  // a pixel of 170 degrees is a metre wide there
}

}  // namespace
}  // namespace lw::test
