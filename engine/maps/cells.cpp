#include "maps/cells.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "maps/packing.h"

namespace lw {
namespace {

constexpr float even_distance = 12;  // steps of the lattice: light from nearer lamps bends too much between nodes
constexpr float least_cos_of_plane = 0.9997f;  // 1.4 degrees
constexpr float least_roughness_of_matte = 0.8f;
constexpr float brightest_direct = 4096;  // of a record; RGB9E5 goes to 65408

/// True when direct light of small lamps looks the same whether it comes from the lamp or from all sides.
bool is_matte(const Material& m) {
    const bool textured = m.metallic_roughness_texture.texture >= 0 || m.normal_texture.texture >= 0;
    return !textured && m.metallic < 0.001f && (m.roughness >= least_roughness_of_matte || m.specular <= 0);
}

/// The maps that are plane and matte all over, with the height of their plane over the grid's origin.
class PlaneMaps {
  public:
    PlaneMaps(const Scene& scene, const PhotonMap& map) : plane_(map.grids.size(), 1), heights_(map.grids.size(), 0) {
        std::vector<char> met(map.grids.size(), 0);
        for (size_t side = 0; side < std::min(map.triangle_maps.size(), 2 * scene.triangles.size()); ++side) {
            map.for_each_map(map.triangle_maps[side], [&](uint m) {
                if (!plane_[m]) return;
                const float first = height_of(scene, map.grids[m], scene.triangles[side / 2].x);
                if (!met[m]) heights_[m] = first;
                met[m] = 1;
                plane_[m] =
                    is_matte(scene.material_of(uint(side / 2))) && lies_in(scene, map.grids[m], side / 2, heights_[m]);
            });
        }
    }
    bool contain(size_t m) const { return plane_[m] != 0; }
    float height(size_t m) const { return heights_[m]; }

  private:
    static float height_of(const Scene& scene, const SurfaceGrid& grid, uint vertex) {
        return dot(scene.positions[vertex] - grid.origin, grid.normal);
    }
    static bool lies_in(const Scene& scene, const SurfaceGrid& grid, size_t triangle, float height) {
        const float most = 0.02f * std::max(grid.lattice.step.x, grid.lattice.step.y);
        for (int c = 0; c < 3; ++c) {
            const uint vertex = scene.triangles[triangle][c];
            if (std::abs(dot(scene.normals[vertex], grid.normal)) < least_cos_of_plane ||
                std::abs(height_of(scene, grid, vertex) - height) > most)
                return false;
        }
        return true;
    }

    std::vector<char> plane_;
    std::vector<float> heights_;
};

/// lux at a point facing `normal` from a lamp of intensity 1, if nothing stands between; falloff as
/// KHR_lights_punctual.
float unshadowed(const Light& light, vec3 position, vec3 normal) {
    if (light.type == light_directional) return std::max(0.0f, -dot(light.direction, normal));
    const vec3 path = light.position - position;
    const float d2 = std::max(dot(path, path), 1e-30f), cosine = dot(path, normal) / std::sqrt(d2);
    return std::max(0.0f, cosine) / d2;
}

/// Cosine from a spot's axis to a point.
float cosine_to_axis(const Light& light, vec3 position) {
    const vec3 path = position - light.position;
    return dot(path, light.direction) / std::max(length(path), 1e-30f);
}

std::array<uint, 4> corners_of(const SurfaceLattice& lattice, uint node) {
    return {node, node + 1, node + lattice.columns, node + lattice.columns + 1};
}

vec3 node_position(const SurfaceGrid& grid, uint node, float height) {
    const uint i = node - grid.lattice.first_node;
    const vec2 uv =
        grid.lattice.low + vec2(float(i % grid.lattice.columns), float(i / grid.lattice.columns)) * grid.lattice.step;
    return grid.origin + uv.x * grid.u_axis + uv.y * grid.v_axis + height * grid.normal;
}

/// Calls body(node) for the lower left node of each cell.
template <class Body>
void for_cells(const SurfaceLattice& lattice, const Body& body) {
    for (uint y = 0; y + 1 < lattice.rows; ++y)
        for (uint x = 0; x + 1 < lattice.columns; ++x) body(lattice.first_node + y * lattice.columns + x);
}

}  // namespace

CellLight::CellLight(const Scene& scene, const PhotonMap& map)
    : scene_(scene), map_(map), lamp_count_(uint(scene.lights.size())) {
    if (!map.has_visible_lamps()) return;
    lamps_.assign(map.coverage.size() * cell_lamp_words(lamp_count_), 0);
    for (uint lamp = 0; lamp < lamp_count_; ++lamp)
        if (scene.lights[lamp].type != light_mesh && scene.lights[lamp].type != light_profile)
            punctual_.push_back(lamp);
    direct_.assign(punctual_.size(), std::vector<float>(map.coverage.size(), 0));
    const PlaneMaps planes(scene, map);
    parallel_for(map.grids.size(), [&](size_t m) {
        describe_cells(map.grids[m]);
        if (planes.contain(m)) add_direct_of_punctuals(map.grids[m], planes.height(m));
    });
    for (const std::vector<float>& lamp : direct_)
        for (float e : lamp) brightest_direct_ = std::max(brightest_direct_, e);
}

void CellLight::describe_cells(const SurfaceGrid& grid) {
    for_cells(grid.lattice, [&](uint node) {
        for (uint lamp = 0; lamp < lamp_count_; ++lamp)
            lamps_[node * cell_lamp_words(lamp_count_) + cell_lamp_word(lamp)] |= describe(grid.lattice, node, lamp)
                                                                                  << cell_lamp_shift(lamp);
    });
}

uint CellLight::describe(const SurfaceLattice& lattice, uint node, uint lamp) const {
    const uint words = visibility_words(lamp_count_);
    uint bits = scene_.lights[lamp].type == light_mesh ? in_cell_light : 0;
    const std::array<uint, 4> corners = corners_of(lattice, node);
    for (uint c = 0; c < 4; ++c) {
        const uint seen = map_.visible_lamps[corners[c] * words + visibility_word(lamp)] >> visibility_shift(lamp);
        bits |= seen & (some_visible | some_hidden);
        if ((seen >> own_shift) & some_visible) bits |= corner_sees << c;
    }
    return bits;
}

/// True when the light of a lamp that all of a cell sees is as good as linear between its corners.
bool CellLight::is_even(const SurfaceGrid& grid, uint node, uint lamp, float height) const {
    const Light& light = scene_.lights[lamp];
    if (light.type == light_directional) return true;
    const float step = std::max(grid.lattice.step.x, grid.lattice.step.y);
    for (uint corner : corners_of(grid.lattice, node)) {
        const vec3 position = node_position(grid, corner, height);
        if (length(light.position - position) < even_distance * step) return false;
        if (light.type == light_spot && cosine_to_axis(light, position) < light.cos_inner) return false;
    }
    return true;
}

void CellLight::add_direct_of_punctuals(const SurfaceGrid& grid, float height) {
    const SurfaceLattice& lattice = grid.lattice;
    for (size_t i = 0; i < punctual_.size(); ++i) {
        const Light& light = scene_.lights[punctual_[i]];
        const uint word = cell_lamp_word(punctual_[i]), shift = cell_lamp_shift(punctual_[i]);
        for_cells(lattice, [&](uint node) {
            uint& bits = lamps_[node * cell_lamp_words(lamp_count_) + word];
            const bool all_visible = ((bits >> shift) & (some_visible | some_hidden)) == some_visible;
            if (!all_visible || !is_even(grid, node, punctual_[i], height)) return;
            bits |= in_cell_light << shift;
            for (uint corner : corners_of(lattice, node))
                direct_[i][corner] = unshadowed(light, node_position(grid, corner, height), grid.normal);
        });
    }
}

bool CellLight::holds(size_t cell, uint lamp) const {
    return (lamps_[cell * cell_lamp_words(lamp_count_) + cell_lamp_word(lamp)] >> cell_lamp_shift(lamp)) &
           in_cell_light;
}

float CellLight::sum(std::span<const vec3> weights, std::vector<uvec4>& light) const {
    assert(weights.size() == lamp_count_);
    const size_t nodes = map_.coverage.size();
    float total = 0;
    for (const vec3& w : weights) total += std::max({w.x, w.y, w.z});
    const float room = std::min(1.0f, brightest_direct / (brightest_direct_ * map_.irradiance_scale));
    const float scale = (total > 0 ? 1 / total : 1.0f) * room, record_scale = scale * map_.irradiance_scale;
    std::vector<vec3> at_nodes(nodes);
    parallel_for(
        nodes,
        [&](size_t n) {
            vec3 e(0);
            for (size_t lamp = 0; lamp < weights.size(); ++lamp)
                if (const uint record = map_.irradiance[lamp * nodes + n])
                    e += unpack_rgb9e5(record) * (weights[lamp] * scale);
            at_nodes[n] = e;
        },
        4096);
    light.assign(nodes, uvec4(0));
    parallel_for(map_.grids.size(), [&](size_t m) {
        for_cells(map_.grids[m].lattice, [&](uint node) {
            const std::array<uint, 4> corners = corners_of(map_.grids[m].lattice, node);
            std::array<vec3, 4> e;
            for (int c = 0; c < 4; ++c) e[size_t(c)] = at_nodes[corners[size_t(c)]];
            for (size_t i = 0; i < punctual_.size(); ++i)
                if (holds(node, punctual_[i]))
                    for (size_t c = 0; c < 4; ++c)
                        e[c] += weights[punctual_[i]] * (record_scale * direct_[i][corners[c]]);
            for (int c = 0; c < 4; ++c) light[node][c] = pack_rgb9e5(e[size_t(c)]);
        });
    });
    return record_scale;
}

}  // namespace lw
