// Density estimation and direct light on the CPU: the text of shaders/gather.glsl and direct.glsl over a PhotonMap; the
// oracle of the gather shader.
#pragma once
#include "maps/irradiance.h"
#include "maps/photon_map.h"
#include "scene/bvh.h"
#include "scene/surface.h"

namespace lw {

/// How photons are turned into radiance; the same settings drive the gather shader.
struct GatherSettings {
    uint mode = gather_mode_cached;
    uint neighbours = 300;  // photons per estimate
    uint shadow_rays = 4;   // per emissive mesh; 0: no rays at all, shadows as sharp as the lattice
};

/// Photon estimate at surface points; read-only view, scene and map must outlive it.
class PhotonEstimator : public SurfaceReader {
  public:
    static constexpr uint heap_size = 1024;  // most neighbours of the exact mode

    /// `light_weights`: RGB power of each light in its own unit (intensity x dimmer).
    PhotonEstimator(const Scene& scene, const PhotonMap& map, const std::vector<vec3>& light_weights,
                    GatherSettings settings, const Bvh& bvh = no_shadows())
        : SurfaceReader(scene),
          grids(map.grids.data()),
          triangle_maps(map.triangle_maps.data()),
          cell_starts(map.cell_starts.data()),
          map_(map),
          weights_(light_weights),
          gather_mode(settings.mode),
          neighbours(settings.neighbours),
          max_radius(map.settings.radius),
          inverse_flux_scale(1.0f / map.flux_scale),
          has_directions(map.has_directions()),
          has_coverage(map.has_coverage()),
          has_visible_lamps(map.has_visible_lamps()),
          visible_lamps(map.visible_lamps.data()),
          lights(scene.lights.data()),
          bvh_nodes(bvh.nodes.data()),
          bvh_triangles(bvh.triangles.data()),
          light_count(uint(scene.lights.size())),
          bvh_node_count(uint(bvh.nodes.size())),
          ray_epsilon(scene.ray_epsilon()),
          scene_size(scene.size()),
          emitters(scene.emitters.data()),
          shadow_rays(settings.shadow_rays),
          has_shadow_rays(settings.shadow_rays > 0),
          has_mirrors(!bvh.nodes.empty()),
          has_direct(!bvh.nodes.empty() && !map.settings.direct_in_photons) {
        if (gather_mode == gather_mode_cached)
            inverse_irradiance_scale = 1 / sum_irradiance(map, light_weights, summed_irradiance_);
    }

    PhotonPlace photon_place(uint i) const { return map_.places[i]; }
    uint photon_flux(uint i) const { return map_.fluxes[i]; }
    uint photon_direction(uint i) const { return map_.directions[i]; }
    vec3 light_weight(uint light) const { return weights_[light]; }
    vec3 lamp_factor(uint light) const {
        vec3 factor(1);
        for (int c = 0; c < 3; ++c)
            if (lights[light].intensity[c] > 0) factor[c] = weights_[light][c] / lights[light].intensity[c];
        return factor;
    }
    Light light_at(uint i) const { return lights[i]; }
    uint node_coverage(uint node) const { return map_.coverage[node]; }
    uint node_irradiance(uint node) const { return summed_irradiance_[node]; }

#include "shaders/direct.glsl"
#include "shaders/gather.glsl"
#include "shaders/rays.glsl"

#include "shaders/shade.glsl"

    /// The estimate at (triangle, barycentrics) seen from direction `to_view` (unit). `seed` picks the points on mesh
    /// lamps.
    Gathered estimate(uint triangle, vec2 barycentrics, vec3 to_view, uint seed = 0) const {
        return shade(triangle, barycentrics, surface_at(triangle, barycentrics).position + to_view, seed).light;
    }

  protected:
    static const Bvh& no_shadows() {
        static const Bvh none;
        return none;
    }

    const SurfaceGrid* grids;
    const uint* triangle_maps;
    const uint* cell_starts;
    const PhotonMap& map_;
    const std::vector<vec3>& weights_;
    uint gather_mode;
    uint neighbours;
    float max_radius;
    float inverse_flux_scale;
    bool has_directions, has_coverage;
    bool has_visible_lamps;
    const uint* visible_lamps;
    const Light* lights;
    const BvhNode* bvh_nodes;
    const uint* bvh_triangles;
    uint light_count, bvh_node_count;
    float ray_epsilon, scene_size;
    const Emitter* emitters;
    uint shadow_rays;
    bool has_shadow_rays;
    static constexpr bool has_mesh_lamps = true;
    bool has_mirrors;
    bool has_direct;
    std::vector<uint> summed_irradiance_;  // cached mode only
    float inverse_irradiance_scale = 1;
};

}  // namespace lw
