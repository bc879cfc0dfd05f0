// Density estimation and direct light on the CPU: the text of shaders/gather.glsl and direct.glsl over a PhotonMap; the
// oracle of the gather shader.
#pragma once
#include <algorithm>
#include <cmath>

#include "maps/cells.h"
#include "maps/photon_map.h"
#include "scene/bvh.h"
#include "scene/surface.h"
#include "shaders/followed.h"

namespace lw {

/// How photons are turned into radiance; the same settings drive the gather shader.
struct GatherSettings {
    uint mode = gather_mode_cached;
    uint neighbours = 300;  // photons per estimate
    // Per emissive mesh; 0: none where the map has a lattice, shadows as sharp as that, of lobes mirrors alone
    // followed.
    uint shadow_rays = 4;
    uint paths = 1;                                     // per pixel along lobes that are followed
    float followed_roughness = max_followed_roughness;  // lobes of surfaces smoother than this, at most 1, are followed
};

/// Photon estimate at surface points; read-only view, scene and map must outlive it.
class PhotonEstimator : public SurfaceReader {
  public:
    static constexpr uint heap_size = 1024;  // most neighbours of the exact mode

    /// `lamp_powers`: RGB power of each light in its own unit (intensity x dimmer).
    PhotonEstimator(const Scene& scene, const PhotonMap& map, const std::vector<vec3>& lamp_powers,
                    GatherSettings settings, const Bvh& bvh = no_shadows())
        : SurfaceReader(scene),
          triangle_maps(map.triangle_maps.data()),
          map_(map),
          weights_(lamp_powers),
          gather_mode(settings.mode),
          neighbours(settings.neighbours),
          max_radius(map.settings.radius),
          inverse_flux_scale(1.0f / map.flux_scale),
          has_caustics(map.caustic_grids > 0),
          has_smooth_caustics(!map.smooth_caustics.empty()),
          has_shadow_masks(!map.shadow_masks.empty()),
          triangle_count_(uint(scene.triangles.size())),
          has_directions(map.has_directions()),
          has_coverage(map.has_coverage()),
          has_visible_lamps(map.has_visible_lamps() && !map.irradiance.empty()),
          lights(scene.lights.data()),
          bvh_nodes(bvh.nodes.data()),
          bvh_triangles(bvh.triangles.data()),
          light_count(uint(scene.lights.size())),
          bvh_node_count(uint(bvh.nodes.size())),
          ray_epsilon(scene.ray_epsilon()),
          scene_size(scene.size()),
          emitters(scene.emitters.data()),
          shadow_rays(settings.shadow_rays),
          has_shadow_rays(settings.shadow_rays > 0 || !map.has_visible_lamps()),
          has_followed(!bvh.nodes.empty()),
          follows_through(!bvh.nodes.empty()),
          followed_roughness(settings.shadow_rays > 0 ? std::min(settings.followed_roughness, 1.0f)
                                                      : std::sqrt(min_alpha)),
          has_direct(!bvh.nodes.empty() && !map.settings.direct_in_photons) {
        if (map.irradiance.empty()) return;
        const CellLight cells(scene, map);
        cell_words_ = cells.words();
        shadow_masks_ = cells.masks();
        if (gather_mode == gather_mode_cached) inverse_irradiance_scale = 1 / cells.sum(lamp_powers, cell_light_);
    }

    PhotonPlace photon_place(uint i) const { return map_.places[i]; }
    uint photon_flux(uint i) const { return map_.fluxes[i]; }
    uint photon_direction(uint i) const { return map_.directions[i]; }
    vec3 lamp_power(uint light) const { return weights_[light]; }
    vec3 lamp_factor(uint light) const {
        const vec3 full = lights[light].intensity;
        vec3 factor(1);
        for (int c = 0; c < 3; ++c)
            if (full[c] > 0) factor[c] = weights_[light][c] / full[c];
        return factor;
    }
    Light light_at(uint i) const { return lights[i]; }
    uint node_coverage(uint node) const { return map_.coverage[node]; }
    uvec4 cell_light(uint cell) const { return cell_light_[cell]; }
    uint cell_word(uint word) const { return cell_words_[word]; }
    uvec4 shadow_mask(uint i) const { return shadow_masks_[i]; }
    uint map_of(uint triangle, bool front) const { return triangle_maps[2 * triangle + (front ? 0 : 1)]; }
    uint caustic_map_of(uint triangle, bool front) const {
        return map_.caustic_map_of(2 * size_t(triangle) + (front ? 0 : 1));
    }
    const SurfaceGrid& grid_at(uint map) const { return map < map_.grids.size() ? map_.grids[map] : no_grid_; }
    bool is_cut(uint map) const { return map < map_.grids.size() && map_.grids[map].columns == 0; }
    uint cell_start(uint cell) const { return map_.cell_starts[cell]; }
    const BvhNode& bvh_node_at(uint i) const { return bvh_nodes[i]; }
    uint bvh_triangle_at(uint i) const { return bvh_triangles[i]; }

#include "shaders/gather.glsl"
#include "shaders/rays.glsl"

#include "shaders/caustics.glsl"
#include "shaders/direct.glsl"

#include "shaders/shade.glsl"

#include "shaders/follow.glsl"

    /// Calls visit(reference, place, squared distance) for the photons of a grid within `radius` of a point in its
    /// frame that lie on the same surface.
    template <class Visit>
    void visit_photons(const SurfaceGrid& grid, vec3 local, float radius, const Visit& visit) const {
        const vec3 reach(radius, radius, 0);
        const ivec2 low = cell_of(local - reach, grid), high = cell_of(local + reach, grid);
        for (int y = low.y; y <= high.y; ++y) {
            const uvec2 span = row_span(grid, low.x, high.x, y);
            for (uint i = span.x; i < span.y; ++i) {
                const PhotonPlace place = photon_place(i);
                const vec3 d = place_in_grid(place, grid) - local;
                const float d2 = dot(d, d);
                if (d2 < radius * radius && on_same_surface(d.z, d2, max_radius)) visit(i, place, d2);
            }
        }
    }

    /// The part of a caustic's kernel at a place that lies on surface; as in shaders/caustics.glsl.
    float caustic_coverage(const MapPlace& at, const SurfaceGrid& grid, float radius) const {
        if (!has_coverage || at.map == no_map) return 1;
        return mix(1.0f, coverage_at(at, radius), min(4.0f * radius / grid.radius, 1.0f));
    }

    /// The estimate at (triangle, barycentrics) seen from direction `to_view` (unit). `seed` picks the points on mesh
    /// lamps, `pixel` the paths that go on.
    Gathered estimate(uint triangle, vec2 barycentrics, vec3 to_view, uint seed = 0, uvec2 pixel = uvec2(0)) const {
        return shade(triangle, barycentrics, surface_at(triangle, barycentrics).position + to_view, seed, pixel);
    }

  protected:
    static const Bvh& no_shadows() {
        static const Bvh none;
        return none;
    }

    const uint* triangle_maps;
    const PhotonMap& map_;
    const std::vector<vec3>& weights_;
    uint gather_mode;
    uint neighbours;
    float max_radius;
    float inverse_flux_scale;
    bool has_caustics, has_smooth_caustics, has_shadow_masks;
    uint triangle_count_;
    bool has_directions, has_coverage;
    bool has_visible_lamps;
    const Light* lights;
    const BvhNode* bvh_nodes;
    const uint* bvh_triangles;
    uint light_count, bvh_node_count;
    float ray_epsilon, scene_size;
    const Emitter* emitters;
    uint shadow_rays;
    bool has_shadow_rays;
    static constexpr uint lobe_paths = 1;
    static constexpr bool has_mesh_lamps = true, has_profiles = true;
    bool has_followed, follows_through;
    float followed_roughness;
    bool has_direct;
    std::vector<uvec4> cell_light_;  // cached mode only
    std::vector<uint> cell_words_;
    std::vector<uvec4> shadow_masks_;
    static constexpr SurfaceGrid no_grid_{};
    float inverse_irradiance_scale = 1;
};

}  // namespace lw
