#include "robustness/room.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include "maps/build.h"
#include "maps/estimate.h"
#include "photons/shoot.h"
#include "scene/gltf_text.h"
#include "trace/build_bvh.h"
#include "trace/emitter.h"

namespace lw::test {
namespace {

constexpr int directions = 600;

std::vector<float> floats_of(const Soup& soup) {
    std::vector<float> values;
    values.reserve(soup.size() * 9);
    for (const Corners& t : soup)
        for (const glm::dvec3& p : t)
            for (int c = 0; c < 3; ++c) values.push_back(float(p[c]));
    return values;
}

Json material(double albedo, double emission, bool double_sided) {
    Json m = {{"pbrMetallicRoughness", {{"baseColorFactor", {albedo, albedo, albedo, 1}}, {"metallicFactor", 0}}},
              {"doubleSided", double_sided},
              {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}};
    if (emission > 0) {
        m["emissiveFactor"] = {1, 1, 1};
        m["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", emission}};
    }
    return m;
}

std::string glb_of(Json doc, std::vector<unsigned char> bytes) {
    while (bytes.size() % 4) bytes.push_back(0);
    doc["buffers"] = {{{"byteLength", bytes.size()}}};
    std::string json = doc.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto word = [](size_t v) {
        std::string text(4, '\0');
        for (size_t i = 0; i < 4; ++i) text[i] = char(v >> (8 * i) & 255);
        return text;
    };
    return "glTF" + word(2) + word(28 + json.size() + bytes.size()) + word(json.size()) + "JSON" + json +
           word(bytes.size()) + std::string("BIN\0", 4) + std::string(bytes.begin(), bytes.end());
}

void add_primitive(GltfText& g, const Soup& soup, const Json& look) {
    if (soup.empty()) return;
    const int accessor = g.accessor(floats_of(soup), "VEC3", 5126);
    g.doc["materials"].push_back(look);
    g.doc["meshes"][0]["primitives"].push_back(
        {{"attributes", {{"POSITION", accessor}}}, {"material", g.doc["materials"].size() - 1}});
}

/// Directions spread evenly over the sphere (Fibonacci).
glm::dvec3 direction(int i) {
    const double z = 1 - (2 * i + 1.0) / directions, r = std::sqrt(1 - z * z), phi = 2.399963229728653 * i;
    return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace

Soup quad(glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v, int columns, int rows) {
    Soup soup;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const auto at = [&](int x, int y) { return corner + u * (double(x) / columns) + v * (double(y) / rows); };
            soup.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            soup.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return soup;
}

Soup box(glm::dvec3 low, glm::dvec3 high, bool inside) {
    Soup soup;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 u(0), v(0), w(0);
        u[(axis + 1) % 3] = (high - low)[(axis + 1) % 3];
        v[(axis + 2) % 3] = (high - low)[(axis + 2) % 3];
        w[axis] = (high - low)[axis];
        soup = joined(soup, inside ? quad(low, u, v) : quad(low, v, u));
        soup = joined(soup, inside ? quad(low + w, v, u) : quad(low + w, u, v));
    }
    return soup;
}

Soup divided(const Soup& soup, int n) {
    Soup parts;
    parts.reserve(soup.size() * size_t(n) * size_t(n));
    for (const auto& [a, b, c] : soup) {
        const glm::dvec3 u = (b - a) / double(n), v = (c - a) / double(n);
        for (int j = 0; j < n; ++j)
            for (int i = 0; i + j < n; ++i) {
                const glm::dvec3 p = a + u * double(i) + v * double(j);
                parts.push_back({p, p + u, p + v});
                if (i + j + 1 < n) parts.push_back({p + u, p + u + v, p + v});
            }
    }
    return parts;
}

Soup moved(Soup soup, const std::function<glm::dvec3(glm::dvec3)>& move) {
    for (Corners& t : soup)
        for (glm::dvec3& p : t) p = move(p);
    return soup;
}

Soup joined(Soup a, const Soup& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

void tell_case(const std::string& what, const std::string& expected, const char* format, ...) {
    char got[256];
    va_list values;
    va_start(values, format);
    std::vsnprintf(got, sizeof got, format, values);
    va_end(values);
    std::printf("| %s | %s | %s |\n", what.c_str(), expected.c_str(), got);
}

Room plain_room() {
    Room room;
    room.walls = box({0, 0, 0}, {4, 3, 5}, true);
    room.block = box({0.6, 0, 0.8}, {1.6, 0.8, 2.0}, false);
    room.panel = quad({0.7, 2.9, 3.2}, {0.8, 0, 0}, {0, 0, 0.8});
    return room;
}

Scene load(const Room& room) {
    GltfText g;
    g.doc["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_specular"};
    g.doc["meshes"] = {{{"primitives", Json::array()}}};
    add_primitive(g, room.walls, material(room.albedo, 0, room.double_sided));
    add_primitive(g, room.block, material(room.albedo, 0, room.double_sided));
    add_primitive(g, room.panel, material(room.albedo, room.panel_luminance, false));
    const double* m = glm::value_ptr(room.node);
    Json lamp = {{"name", "lamp"}, {"translation", {room.lamp.x, room.lamp.y, room.lamp.z}}};
    lamp["extensions"]["KHR_lights_punctual"]["light"] = 0;
    g.doc["scenes"] = {{{"nodes", {0}}}};
    g.doc["nodes"] = {{{"matrix", std::vector<double>(m, m + 16)}, {"children", {1, 2, 3}}},
                      {{"mesh", 0}},
                      lamp,
                      {{"camera", 0}, {"translation", {room.eye.x, room.eye.y, room.eye.z}}, {"name", "eye"}}};
    g.doc["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", room.yfov}, {"znear", room.znear}}}}};
    g.doc["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", room.candela}}};
    return load_gltf(GltfText::write(glb_of(g.doc, g.bytes), "disguised.glb"));
}

Baked::Baked(const Room& room, uint64_t photon_count, uint64_t seed, bool direct_in_photons)
    : scene(load(room)),
      caster(scene),
      photons(shoot_photons(scene, caster,
                            {.photons = photon_count, .seed = seed, .direct_in_photons = direct_in_photons})),
      map(build_photon_map(scene, caster, photons,
                           {.photons = photon_count, .seed = seed, .direct_in_photons = direct_in_photons})) {}

Readings read(const Baked& baked, const Room& room, uint mode) {
    const Bvh bvh = build_bvh(baked.scene);
    const std::vector<vec3> weights = lamp_powers(baked.scene, {});
    const PhotonEstimator estimator(baked.scene, baked.map, weights, {mode, 200, 4}, bvh);
    const glm::dvec3 eye = glm::dvec3(room.node * glm::dvec4(room.eye, 1)) - baked.scene.origin;
    const glm::dmat4 back = glm::inverse(room.node);
    Readings readings;
    for (int i = 0; i < directions; ++i) {
        const vec3 ray(glm::normalize(glm::dmat3(room.node) * direction(i)));
        const std::optional<Hit> hit = baked.caster.nearest(vec3(eye), ray);
        readings.lux.push_back(-1);
        readings.places.emplace_back(0);
        if (!hit) continue;
        const Gathered light = estimator.estimate(hit->triangle, hit->barycentrics, -ray, uint(i));
        readings.lux.back() = double(luminance(light.irradiance));
        const glm::dvec3 world = baked.scene.origin + eye + glm::dvec3(ray) * double(hit->distance);
        readings.places.back() = (glm::dvec3(back * glm::dvec4(world, 1)) - room.eye) / room.unit;
    }
    return readings;
}

Difference difference(const Readings& a, const Readings& b, double scale) {
    Difference d;
    double sum_a = 0, sum_b = 0, squares = 0;
    for (size_t i = 0; i < a.lux.size(); ++i) {
        if (a.lux[i] < 0 || b.lux[i] < 0 || glm::length(a.places[i] - b.places[i]) > 0.01) continue;
        const double other = b.lux[i] / scale;
        ++d.compared, sum_a += a.lux[i], sum_b += other, squares += (a.lux[i] - other) * (a.lux[i] - other);
    }
    d.mean_ratio = sum_b / sum_a;
    d.rmse = std::sqrt(squares / double(d.compared)) / (sum_a / double(d.compared));
    return d;
}

}  // namespace lw::test
