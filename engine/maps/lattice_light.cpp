#include "maps/lattice_light.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "maps/packing.h"
#include "maps/plane_grids.h"

namespace lw {
namespace {

constexpr float even_distance = 12;  // lattice steps: light of nearer lamps is not linear enough between nodes
constexpr float max_direct = 4096;   // largest direct light in a record; RGB9E5 goes to 65408

/// Illuminance, lux, at a point facing `normal` from a lamp of intensity 1, if nothing stands between; falloff as in
/// KHR_lights_punctual.
float unshadowed(const Light& light, vec3 position, vec3 normal) {
    if (comes_from_outside(light.type)) return std::max(0.0f, -dot(light.direction, normal));
    const vec3 path = light.position - position;
    const float d2 = std::max(dot(path, path), 1e-30f), cosine = dot(path, normal) / std::sqrt(d2);
    return std::max(0.0f, cosine) / d2;
}

std::array<uint, 4> corners_of(const SurfaceLattice& lattice, uint node) {
    return {node, node + 1, node + lattice.columns, node + lattice.columns + 1};
}

vec3 node_position(const SurfaceGrid& grid, uint node, float height) {
    const uint i = node - grid.lattice.first_node;
    return point_on_lattice(grid, vec2(float(i % grid.lattice.columns), float(i / grid.lattice.columns)), height);
}

/// Calls body(node) for the lower left node of each lattice cell.
template <class Body>
void for_lattice_cells(const SurfaceLattice& lattice, const Body& body) {
    for (uint y = 0; y + 1 < lattice.rows; ++y)
        for (uint x = 0; x + 1 < lattice.columns; ++x) body(lattice.first_node + y * lattice.columns + x);
}

}  // namespace

LatticeLight::LatticeLight(const Scene& scene, const PhotonMap& map)
    : scene_(scene),
      map_(map),
      lamp_count_(uint(scene.lights.size())),
      first_lamp_column_(map.has_marks() ? 1 : 0),
      row_length_(lattice_row_length(lamp_count_, map.has_marks())) {
    if (!map.has_visible_lamps()) return;
    rows_.assign(map.coverage.size() * row_length_, 0);
    for (uint lamp = 0; lamp < lamp_count_; ++lamp)
        if (is_linear_in_cells(scene.lights[lamp].type)) punctual_.push_back(lamp);
    const PlaneGrids planes(scene, map);
    parallel_for(map.grids.size(), [&](size_t m) { fill_rows(map.grids[m]); });
    for (const ShadowMask& mask : map.shadow_masks) add_mask(mask);
    std::vector<uint> direct(punctual_.size() * map.coverage.size(), 0);
    parallel_for(map.grids.size(), [&](size_t m) {
        if (planes.is_matte_plane(m)) add_direct_of_punctuals(map.grids[m], planes.height(m), direct);
    });
    direct_ = SparseArray(direct);
    for (uint e : direct_.values) max_direct_ = std::max(max_direct_, uintBitsToFloat(e));
}

uint& LatticeLight::lamp_column(size_t cell, uint lamp) {
    return rows_[cell * row_length_ + first_lamp_column_ + lattice_lamp_column(lamp)];
}

void LatticeLight::fill_rows(const SurfaceGrid& grid) {
    for_lattice_cells(grid.lattice, [&](uint node) {
        for (uint lamp = 0; lamp < lamp_count_; ++lamp)
            lamp_column(node, lamp) |= lamp_bits(grid.lattice, node, lamp) << lattice_lamp_shift(lamp);
        const std::array<uint, 4> corners = corners_of(grid.lattice, node);
        for (uint c = 0; c < 4; ++c)
            if (map_.holds_caustics(corners[c])) rows_[node * row_length_] |= 1u << c;
    });
}

/// Adds a mask to its cell. A mask that is lit or dark everywhere only changes the lamp's bits; others are kept.
void LatticeLight::add_mask(const ShadowMask& mask) {
    uint& bits = lamp_column(mask.cell, mask.lamp);
    const uint shift = lattice_lamp_shift(mask.lamp);
    const bool dark = (mask.lit_low | mask.lit_high) == 0;
    if (dark || ((mask.lit_low & mask.lit_high) == ~0u && unpack_rgb9e5(mask.tint) == vec3(1))) {
        bits &= ~((dark ? some_visible : some_hidden) << shift);
        return;
    }
    if (masked_cell_ != mask.cell) rows_[size_t(mask.cell) * row_length_] |= uint(masks_.size()) << first_mask_shift;
    masked_cell_ = mask.cell;
    bits |= has_shadow_mask << shift;
    masks_.emplace_back(mask.lit_low, mask.lit_high, mask.tint, 0);
}

uint LatticeLight::lamp_bits(const SurfaceLattice& lattice, uint node, uint lamp) const {
    const uint length = visibility_row_length(lamp_count_);
    uint bits = is_delta(scene_.lights[lamp].type) ? 0 : in_lattice_light;
    const std::array<uint, 4> corners = corners_of(lattice, node);
    for (uint c = 0; c < 4; ++c) {
        const uint seen = map_.visible_lamps[corners[c] * length + visibility_column(lamp)] >> visibility_shift(lamp);
        bits |= seen & (some_visible | some_hidden);
        if ((seen >> own_shift) & some_visible) bits |= corner_sees << c;
    }
    return bits;
}

/// True when the light of a lamp, which all of the cell sees, is nearly linear between the corners.
bool LatticeLight::is_even(const SurfaceGrid& grid, uint node, uint lamp, float height) const {
    const Light& light = scene_.lights[lamp];
    if (comes_from_outside(light.type)) return true;
    const float step = std::max(grid.lattice.step.x, grid.lattice.step.y);
    for (uint corner : corners_of(grid.lattice, node)) {
        const vec3 position = node_position(grid, corner, height);
        if (length(light.position - position) < even_distance * step) return false;
        if (!is_fully_lit(light, position)) return false;
    }
    return true;
}

void LatticeLight::add_direct_of_punctuals(const SurfaceGrid& grid, float height, std::vector<uint>& direct) {
    const SurfaceLattice& lattice = grid.lattice;
    for (size_t i = 0; i < punctual_.size(); ++i) {
        const Light& light = scene_.lights[punctual_[i]];
        const uint shift = lattice_lamp_shift(punctual_[i]);
        for_lattice_cells(lattice, [&](uint node) {
            uint& bits = lamp_column(node, punctual_[i]);
            const bool all_visible = ((bits >> shift) & (some_visible | some_hidden)) == some_visible;
            if (!all_visible || !is_even(grid, node, punctual_[i], height)) return;
            bits |= in_lattice_light << shift;
            for (uint corner : corners_of(lattice, node))
                direct[i * map_.coverage.size() + corner] =
                    floatBitsToUint(unshadowed(light, node_position(grid, corner, height), grid.normal));
        });
    }
}

bool LatticeLight::holds(size_t cell, uint lamp) const {
    return (rows_[cell * row_length_ + first_lamp_column_ + lattice_lamp_column(lamp)] >> lattice_lamp_shift(lamp)) &
           in_lattice_light;
}

float LatticeLight::scale_of(std::span<const vec3> powers) const {
    float total = 0;
    for (const vec3& w : powers) total += std::max({w.x, w.y, w.z});
    const float room = std::min(1.0f, max_direct / (max_direct_ * map_.irradiance_scale));
    return (total > 0 ? 1 / total : 1.0f) * room;
}

float LatticeLight::sum(std::span<const vec3> powers, std::vector<uvec4>& light) const {
    assert(powers.size() == lamp_count_);
    const size_t nodes = map_.coverage.size();
    const float scale = scale_of(powers), record_scale = scale * map_.irradiance_scale;
    std::vector<vec3> at_nodes(nodes);
    parallel_for(
        nodes,
        [&](size_t n) {
            vec3 e(0);
            for (size_t lamp = 0; lamp < powers.size(); ++lamp)
                if (const uint record = map_.irradiance[lamp * nodes + n])
                    e += unpack_rgb9e5(record) * (powers[lamp] * scale);
            at_nodes[n] = e;
        },
        4096);
    light.assign(nodes, uvec4(0));
    parallel_for(map_.grids.size(), [&](size_t m) {
        for_lattice_cells(map_.grids[m].lattice, [&](uint node) {
            const std::array<uint, 4> corners = corners_of(map_.grids[m].lattice, node);
            std::array<vec3, 4> e;
            for (int c = 0; c < 4; ++c) e[size_t(c)] = at_nodes[corners[size_t(c)]];
            for (size_t i = 0; i < punctual_.size(); ++i)
                if (holds(node, punctual_[i]))
                    for (size_t c = 0; c < 4; ++c)
                        e[c] +=
                            powers[punctual_[i]] * (record_scale * uintBitsToFloat(direct_[i * nodes + corners[c]]));
            for (int c = 0; c < 4; ++c) light[node][c] = pack_rgb9e5(e[size_t(c)]);
        });
    });
    return record_scale;
}

}  // namespace lw
