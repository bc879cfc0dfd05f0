#include "maps/plane_grids.h"

#include <algorithm>
#include <cmath>

namespace lw {
namespace {

constexpr float min_cos_of_plane = 0.9997f;  // 1.4 degrees
constexpr float min_roughness_of_matte = 0.8f;

/// True when the material is so matte that light of a small lamp may be treated as light from all sides.
bool is_matte(const Material& m) {
    const bool textured = m.metallic_roughness_texture.texture >= 0 || m.normal_texture.texture >= 0;
    const auto largest = [](vec3 v) { return std::max({v.x, v.y, v.z}); };
    const float r = (m.ior - 1) / (m.ior + 1), reflectance = r * r * largest(m.specular_color) * m.specular;
    const float max_reflectance = std::min(0.08f, 0.4f * largest(m.base_color));  // at normal incidence
    const bool is_dull = m.roughness >= min_roughness_of_matte && reflectance <= max_reflectance;
    return !textured && m.metallic < 0.001f && (is_dull || m.specular <= 0);
}

}  // namespace

PlaneGrids::PlaneGrids(const Scene& scene, const SurfaceGrids& surfaces)
    : plane_(surfaces.grids.size(), 1), matte_(surfaces.grids.size(), 1), heights_(surfaces.grids.size(), -1e30f) {
    std::vector<float> lowest(surfaces.grids.size(), 1e30f);
    for (size_t side = 0; side < surfaces.grid_of_side.size(); ++side) {
        surfaces.for_each_grid(surfaces.grid_of_side[side], [&](uint m) {
            const SurfaceGrid& grid = surfaces.grids[m];
            if (matte_[m] && !is_matte(scene.material_of(uint(side / 2)))) matte_[m] = 0;
            for (int c = 0; c < 3; ++c) {
                const uint vertex = scene.triangles[side / 2][c];
                const float height = dot(scene.positions[vertex] - grid.origin, grid.normal);
                heights_[m] = std::max(heights_[m], height), lowest[m] = std::min(lowest[m], height);
                if (std::abs(dot(scene.normals[vertex], grid.normal)) < min_cos_of_plane) matte_[m] = 0;
            }
        });
    }
    for (size_t m = 0; m < surfaces.grids.size(); ++m) {
        const vec2 step = surfaces.grids[m].lattice.step;
        plane_[m] = heights_[m] - lowest[m] <= 0.02f * std::max(step.x, step.y);
    }
}

vec3 point_on_lattice(const SurfaceGrid& grid, vec2 cells, float height) {
    const vec2 uv = grid.lattice.low + cells * grid.lattice.step;
    return position_of(grid, vec3(uv, height));
}

}  // namespace lw
