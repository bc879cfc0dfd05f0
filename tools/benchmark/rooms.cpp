#include "rooms.h"

#include <algorithm>
#include <cmath>

#include "scene/content_hash.h"
#include "scene/gltf_materials.h"

namespace lw {
namespace {

constexpr vec3 room_size(10, 3, 8);                   // m
constexpr float total_flux = 20'000;                  // lm
constexpr float panel_side = 0.6f;                    // m
constexpr size_t coarse_triangles = 2 * 6 * (1 + 5);  // the shell and five boxes
constexpr size_t min_sculpture_triangles = 200;
constexpr uint texture_side = 256;  // texels

enum MaterialIndex : uint { walls, furniture, sculpture, lamp };

struct Box {
    vec3 low, high;
};
constexpr Box boxes[] = {{{1, 0, 1}, {2, 0.75f, 2.6f}},
                         {{4.2f, 0, 3}, {6, 0.72f, 4}},
                         {{7.6f, 0, 0.8f}, {9, 1.1f, 1.6f}},
                         {{8.4f, 0, 5}, {9.4f, 2, 6.8f}},
                         {{2, 0, 6}, {4, 0.45f, 7}}};

/// A parallelogram with its front on the side of cross(u, v).
struct Quad {
    vec3 corner, u, v;
};

/// Fills the arrays of a Scene; `edge` is the wanted length of the triangles' legs on flat faces, m.
class RoomMaker {
  public:
    RoomMaker(Scene& scene, float edge, bool textured) : scene_(scene), edge_(edge), textured_(textured) {}

    void begin_object(const std::string& name, uint material, int light = -1) {
        scene_.objects.push_back({material, light});
        scene_.object_names.push_back(name);
    }
    void add_quad(const Quad& quad) {
        const auto pieces = [&](vec3 side) { return std::max(1u, uint(std::lround(length(side) / edge_))); };
        const vec3 normal = normalize(cross(quad.u, quad.v));
        add_grid(pieces(quad.u), pieces(quad.v), [&](float u, float v) {
            return Vertex{quad.corner + u * quad.u + v * quad.v, normal, vec2(u * length(quad.u), v * length(quad.v))};
        });
    }
    /// Faces outwards; inwards when `inside`.
    void add_box(const Box& box, bool inside) {
        const vec3 size = box.high - box.low;
        for (int axis = 0; axis < 3; ++axis) {
            vec3 u(0), v(0), w(0);
            u[(axis + 1) % 3] = size[(axis + 1) % 3];
            v[(axis + 2) % 3] = size[(axis + 2) % 3];
            w[axis] = size[axis];
            inside ? add_quad({box.low, u, v}) : add_quad({box.low, v, u});
            inside ? add_quad({box.low + w, v, u}) : add_quad({box.low + w, u, v});
        }
    }
    void add_sphere(vec3 centre, float radius, uint rings) {
        add_grid(2 * rings, rings, [&](float u, float v) {
            const float phi = 2 * lw_pi * u, theta = lw_pi * (1 - v);
            const vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
            return Vertex{centre + radius * n, n, vec2(u, v)};
        });
    }
    /// Lies flat; `radius` of the ring, `thickness` of its tube.
    void add_torus(vec3 centre, float radius, float thickness, uint rings) {
        add_grid(2 * rings, rings, [&](float u, float v) {
            const float phi = 2 * lw_pi * u, theta = 2 * lw_pi * v;
            const vec3 out(std::cos(phi), 0, -std::sin(phi));
            const vec3 n = std::cos(theta) * out + vec3(0, std::sin(theta), 0);
            return Vertex{centre + radius * out + thickness * n, n, vec2(u, v)};
        });
    }

  private:
    struct Vertex {
        vec3 position, normal;
        vec2 uv;
    };

    /// columns x rows cells of two triangles over vertex(u, v), u and v in [0, 1]; u x v is the front.
    template <class VertexAt>
    void add_grid(uint columns, uint rows, const VertexAt& vertex) {
        const auto first = uint(scene_.positions.size());
        for (uint j = 0; j <= rows; ++j)
            for (uint i = 0; i <= columns; ++i) add_vertex(vertex(float(i) / float(columns), float(j) / float(rows)));
        for (uint j = 0; j < rows; ++j)
            for (uint i = 0; i < columns; ++i) {
                const uint a = first + j * (columns + 1) + i, c = a + columns + 1;
                add_triangle({a, a + 1, c + 1});
                add_triangle({a, c + 1, c});
            }
    }
    void add_vertex(const Vertex& vertex) {
        scene_.positions.push_back(vertex.position);
        scene_.normals.push_back(vertex.normal);
        if (textured_) scene_.uv0.push_back(vertex.uv);
    }
    /// The triangles at the poles of a sphere have no area and are left out.
    void add_triangle(uvec3 corners) {
        const std::vector<vec3>& p = scene_.positions;
        if (length(edge_product(p[corners.x], p[corners.y], p[corners.z])) < 1e-10f) return;
        scene_.triangles.push_back(corners);
        scene_.triangle_objects.push_back(uint(scene_.objects.size() - 1));
    }

    Scene& scene_;
    float edge_;
    bool textured_;
};

Material lambert(vec3 color) {
    Material m = default_material();
    m.base_color = color;
    m.metallic = m.specular = 0;
    return m;
}

void add_materials(Scene& scene, Finish finish) {
    scene.materials = {lambert(vec3(0.75f)), lambert({0.4f, 0.5f, 0.6f}), lambert({0.7f, 0.65f, 0.5f}),
                       lambert(vec3(0))};
    scene.material_names = {"walls", "furniture", "sculpture", "lamp"};
    if (finish == Finish::glossy)
        for (uint m : {walls, furniture, sculpture}) {
            scene.materials[m].specular = 1;
            scene.materials[m].roughness = 0.4f;
        }
    if (finish == Finish::glass) {
        Material& glass = scene.materials[sculpture];
        glass.base_color = vec3(1);
        glass.specular = glass.transmission = 1;
        glass.roughness = 0;
        glass.ior = 1.5f;
    }
    if (finish == Finish::textured) scene.materials[walls].base_color_texture.texture = 0;
}

/// A checker of two light greys, repeated every metre.
void add_texture(Scene& scene) {
    scene.textures.push_back({0, texture_side, texture_side, wrap_repeat, wrap_repeat, 1, 0});
    for (uint y = 0; y < texture_side; ++y)
        for (uint x = 0; x < texture_side; ++x)
            scene.texels.push_back(((x ^ y) & (texture_side / 2)) != 0 ? 0xffffffffu : 0xffd0d0d0u);
}

/// Centre of place `i` of `count` on the ceiling.
vec3 lamp_place(uint i, uint count, float height) {
    const auto columns = uint(std::ceil(std::sqrt(float(count) * room_size.x / room_size.z)));
    const uint rows = (count + columns - 1) / columns;
    return {room_size.x * (float(i % columns) + 0.5f) / float(columns), height,
            room_size.z * (float(i / columns) + 0.5f) / float(rows)};
}

void add_point(Scene& scene, uint i, uint count) {
    Light light{};
    light.type = light_point;
    light.intensity = vec3(total_flux / float(count) / (4 * lw_pi));
    light.position = lamp_place(i, count, 2.2f);
    light.direction = vec3(0, -1, 0);
    scene.lights.push_back(light);
    scene.light_names.push_back("point" + std::to_string(i));
}

void add_panel(Scene& scene, RoomMaker& maker, uint i, uint count) {
    Light light{};
    light.type = light_mesh;
    light.area = panel_side * panel_side;
    light.intensity = vec3(total_flux / float(count) / (lw_pi * light.area));
    light.position = lamp_place(i, count, 2.97f);
    light.direction = vec3(0, -1, 0);
    light.first_emitter = uint(scene.emitters.size());
    scene.materials[lamp].emissive = light.intensity;
    maker.begin_object("panel" + std::to_string(i), lamp, int(scene.lights.size()));
    const auto first = uint(scene.triangles.size());
    const vec3 half(0.5f * panel_side, 0, 0.5f * panel_side);
    maker.add_quad({light.position - half, vec3(panel_side, 0, 0), vec3(0, 0, panel_side)});
    light.emitter_count = uint(scene.triangles.size()) - first;
    for (uint t = 0; t < light.emitter_count; ++t)  // triangles of equal area
        scene.emitters.push_back({first + t, light.area * float(t + 1) / float(light.emitter_count)});
    scene.lights.push_back(light);
    scene.light_names.push_back("panel" + std::to_string(i));
}

/// `rings` rows of faces each: 4 rings^2 triangles a piece.
void add_sculptures(RoomMaker& maker, uint rings) {
    maker.begin_object("sculptures", sculpture);
    maker.add_sphere({1.5f, 1.05f, 1.8f}, 0.3f, rings);
    maker.add_sphere({6.5f, 0.4f, 6.2f}, 0.4f, rings);
    maker.add_torus({5.1f, 0.82f, 3.5f}, 0.3f, 0.1f, rings);
    maker.add_torus({3, 0.57f, 6.5f}, 0.32f, 0.12f, rings);
}

/// Leg of the right triangles that tile the flat faces with `triangles` of them, m.
float edge_for(size_t triangles) {
    const auto surface = [](vec3 s) { return 2 * (s.x * s.y + s.y * s.z + s.z * s.x); };
    float area = surface(room_size);
    for (const Box& box : boxes) area += surface(box.high - box.low);
    return std::sqrt(2 * area / float(triangles));
}

Camera corner_camera() {
    Camera camera;
    camera.name = "corner";
    camera.position = vec3(0.4f, 1.7f, 7.6f);
    const vec3 back = normalize(camera.position - vec3(6.2f, 0.7f, 2.6f));
    const vec3 right = normalize(cross(vec3(0, 1, 0), back));
    camera.rotation = mat3(right, cross(back, right), back);
    camera.yfov = 1.05f;
    return camera;
}

void finish_scene(Scene& scene) {
    scene.cameras = {corner_camera()};
    scene.bounds = {scene.positions[0], scene.positions[0]};
    for (const vec3& p : scene.positions) {
        scene.bounds[0] = min(scene.bounds[0], p);
        scene.bounds[1] = max(scene.bounds[1], p);
    }
    scene.content_hash = content_hash(scene);
}

}  // namespace

Scene make_room(const RoomSettings& settings) {
    Scene scene;
    scene.path = "room";
    const bool uniform = settings.tessellation == Tessellation::uniform;
    const size_t flat = uniform ? size_t(double(settings.triangles) * 0.96) : coarse_triangles;
    const size_t fine = settings.triangles > flat ? settings.triangles - flat : 0;
    RoomMaker maker(scene, uniform ? edge_for(flat) : 1e9f, settings.finish == Finish::textured);
    add_materials(scene, settings.finish);
    if (settings.finish == Finish::textured) add_texture(scene);
    maker.begin_object("walls", walls);
    maker.add_box({vec3(0), room_size}, true);
    maker.begin_object("furniture", furniture);
    for (const Box& box : boxes) maker.add_box(box, false);
    if (fine >= min_sculpture_triangles) add_sculptures(maker, uint(std::sqrt(float(fine) / 16)));
    for (uint i = 0; i < settings.lights; ++i) {
        const bool point = settings.lamps == Lamps::points || (settings.lamps == Lamps::alternating && i % 2 == 1);
        point ? add_point(scene, i, settings.lights) : add_panel(scene, maker, i, settings.lights);
    }
    finish_scene(scene);
    return scene;
}

const char* name_of(Tessellation tessellation) { return tessellation == Tessellation::uniform ? "uniform" : "mixed"; }

}  // namespace lw
