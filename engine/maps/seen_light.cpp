#include "maps/seen_light.h"

#include <array>

#include "scene/triangle.h"

namespace lw {

SeenLight::SeenLight(const Scene& scene, const Lattice& lattice, const std::vector<uint>& visible_lamps, uint lamp,
                     std::span<const vec3> nodes)
    : scene_(scene), lattice_(lattice), visible_lamps_(visible_lamps), lamp_(lamp), nodes_(nodes), emitters_(scene) {}

bool SeenLight::sees_lamp(uint node) const {
    const uint row_length = visibility_row_length(uint(scene_.lights.size()));
    const uint bits = visible_lamps_[size_t(node) * row_length + visibility_column(lamp_)] >> visibility_shift(lamp_);
    return ((bits >> own_shift) & some_visible) != 0;
}

std::optional<vec3> SeenLight::irradiance(uint side, vec3 position) const {
    const PatchGrids& surfaces = lattice_.surfaces;
    const uint index = surfaces.behind_cuts(surfaces.grid_of_side[side], position);
    if (index == no_grid) return std::nullopt;
    const SurfaceGrid& grid = surfaces.grids[index];
    const SurfaceLattice& lattice = grid.lattice;
    const vec2 last(float(lattice.columns - 1), float(lattice.rows - 1));
    const vec2 at = clamp((vec2(position_in_grid(grid, position)) - lattice.low) / lattice.step, vec2(0), last);
    const vec2 base = min(floor(at), last - 1.0f), f = at - base;
    const uint node = lattice.first_node + uint(base.y) * lattice.columns + uint(base.x);
    const std::array<uint, 4> corners{node, node + 1, node + lattice.columns, node + lattice.columns + 1};
    const std::array<float, 4> weights{(1 - f.x) * (1 - f.y), f.x * (1 - f.y), (1 - f.x) * f.y, f.x * f.y};
    vec3 sum(0);
    float total = 0, seen = 0;
    const bool asks = is_delta(scene_.lights[lamp_].type);
    for (size_t c = 0; c < corners.size(); ++c) {
        if (weights[c] <= 0 || !lattice_.nodes[corners[c]].exists()) continue;
        total += weights[c];
        sum += nodes_[corners[c]] * weights[c];
        if (asks && sees_lamp(corners[c])) seen += weights[c];
    }
    if (total <= 0) return std::nullopt;
    sum /= total;
    if (seen <= 0) return sum;
    const auto in = emitters_.arrive(lamp_, position, 0.5f, 0.5f);
    if (!in) return sum;
    const vec3 normal = normalize(triangle_product(scene_, side / 2)) * (side % 2 ? -1.0f : 1.0f);
    return sum + in->radiance * (std::max(dot(in->to_light, normal), 0.0f) * seen / total);
}

}  // namespace lw
