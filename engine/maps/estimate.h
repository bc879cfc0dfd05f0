// The light of a pixel on the CPU: the shaders' text of density estimation and direct light over a Scene and a
// PhotonMap. Tests and the benchmark compare the shaders with it; the probe and reports use it for the light that a
// viewer sees. Code that only looks up photons uses maps/map_reader.h.
#pragma once
#include <cassert>
#include <memory>

#include "maps/gather_settings.h"
#include "maps/lattice_light.h"
#include "maps/map_reader.h"
#include "scene/bvh.h"
#include "scene/surface.h"
#include "shaders/color.h"
#include "shaders/followed.h"

namespace lw {

/// The kinds of records that the text reads.
enum class Record { surface, grid, cell, photon, flux, direction, box, triangle, number };

/// A `Count` that does nothing.
struct Uncounted {
    void operator()(Record) const {}
};

/// The shaders' text with the functions and constants that it expects. It calls counted(kind), of type `Count`, for
/// each record that it reads. It inherits SurfaceReader because the text calls the functions of a surface by name.
/// Scene, map, hierarchy and powers must outlive it.
template <class Count>
class GatherText : public SurfaceReader {
  public:
    /// `lamp_powers`: RGB power of each light in its own unit (intensity x dimmer).
    GatherText(const Scene& scene, const PhotonMap& map, const std::vector<vec3>& lamp_powers, GatherSettings settings,
               const Bvh& bvh = no_shadows())
        : SurfaceReader(scene),
          gather_mode(settings.mode),
          neighbours(settings.neighbours),
          shadow_rays(settings.shadow_rays),
          has_shadow_rays(lw::has_shadow_rays(settings, map.has_visible_lamps())),
          followed_roughness(lw::followed_roughness(settings)),
          scene_(scene),
          map_(map),
          maps_(map, settings.neighbours),
          bvh_(bvh),
          powers_(&lamp_powers) {
        if (map.irradiance.empty()) return;
        const LatticeLight cells(scene, map);
        cells_ = std::make_shared<const Cells>(Cells{cells.rows(), cells.masks()});
        if (gather_mode == gather_mode_cached) inverse_irradiance_scale = 1 / cells.sum(lamp_powers, lattice_light_);
    }

    /// A copy with the lamps at other powers, which must outlive it. Not for the cached mode, whose cells hold sums
    /// over lamps.
    GatherText with_powers(const std::vector<vec3>& lamp_powers) const {
        assert(gather_mode != gather_mode_cached);
        GatherText other = *this;
        other.powers_ = &lamp_powers;
        return other;
    }

    PhotonPlace photon_place(uint i) const { return counted(Record::photon), map_.places[i]; }
    uint photon_flux(uint i) const { return counted(Record::flux), map_.fluxes[i]; }
    uint photon_direction(uint i) const { return counted(Record::direction), map_.directions[i]; }
    vec3 lamp_power(uint light) const { return (*powers_)[light]; }
    vec3 lamp_factor(uint light) const {
        const vec3 full = scene_.lights[light].intensity;
        vec3 factor(1);
        for (int c = 0; c < 3; ++c)
            if (full[c] > 0) factor[c] = lamp_power(light)[c] / full[c];
        return factor;
    }
    Light light_at(uint i) const { return scene_.lights[i]; }
    Surface surface_at(uint triangle, vec2 barycentrics) const {
        return counted(Record::surface), SurfaceReader::surface_at(triangle, barycentrics);
    }
    uint node_coverage(uint node) const { return counted(Record::number), maps_.node_coverage(node); }
    uvec4 lattice_light(uint cell) const { return counted(Record::cell), lattice_light_[cell]; }
    uint lattice_row_entry(uint i) const { return counted(Record::number), cells_->rows[i]; }
    uvec4 shadow_mask(uint i) const { return counted(Record::cell), cells_->masks[i]; }
    uint grid_of(uint triangle, bool front) const { return counted(Record::number), maps_.grid_of(triangle, front); }
    uint caustic_grid_of(uint triangle, bool front) const {
        return counted(Record::number), maps_.caustic_grid_of(triangle, front);
    }
    const SurfaceGrid& grid_at(uint index) const { return counted(Record::grid), maps_.grid_at(index); }
    const Cut& cut_at(uint i) const { return maps_.cut_at(i); }
    uint cell_start(uint cell) const { return counted(Record::number), maps_.cell_start(cell); }
    const BvhNode& bvh_node_at(uint i) const { return counted(Record::box), bvh_.nodes[i]; }
    uint bvh_triangle_at(uint i) const { return counted(Record::triangle), bvh_.triangles[i]; }

#include "shaders/map_lookup.glsl"

#include "shaders/gather.glsl"
#include "shaders/rays.glsl"

#include "shaders/caustics.glsl"
#include "shaders/lights.glsl"

#include "shaders/direct.glsl"

#include "shaders/shade.glsl"

#include "shaders/follow.glsl"

    /// All light from the point (triangle, barycentrics) in unit direction `to_view`. `seed` chooses the points on mesh
    /// lamps, `pixel` the followed paths.
    Gathered estimate(uint triangle, vec2 barycentrics, vec3 to_view, uint seed = 0, uvec2 pixel = uvec2(0)) const {
        return shade(triangle, barycentrics, surface_at(triangle, barycentrics).position + to_view, seed, pixel);
    }

    Count counted;

  private:
    /// What lattice cells know of the lamps, LatticeLight::rows() and masks().
    struct Cells {
        std::vector<uint> rows;
        std::vector<uvec4> masks;
    };
    static const Bvh& no_shadows() {
        static const Bvh none;
        return none;
    }

    // What the text calls by these names: of the settings, then of scene and map.
    uint gather_mode, neighbours, shadow_rays;
    bool has_shadow_rays;
    float followed_roughness;
    static constexpr uint heap_size = max_exact_neighbours, lobe_paths = 1;
    static constexpr bool has_area_lamps = true, has_profiles = true;

    const Scene& scene_;
    const PhotonMap& map_;
    MapReader maps_;
    const Bvh& bvh_;
    const std::vector<vec3>* powers_;
    std::shared_ptr<const Cells> cells_;  // none without irradiance at the nodes
    std::vector<uvec4> lattice_light_;    // cached mode only
    float inverse_irradiance_scale = 1;

    float inverse_flux_scale = 1.0f / map_.flux_scale;
    bool has_directions = map_.has_directions(), has_coverage = map_.has_coverage();
    bool has_caustics = map_.caustic_grids > 0, has_smooth_caustics = !map_.smooth_caustics.empty();
    bool has_visible_lamps = map_.has_visible_lamps() && !map_.irradiance.empty();
    bool has_shadow_masks = !map_.shadow_masks.empty();
    const Emitter* emitters = scene_.emitters.data();
    uint light_count = uint(scene_.lights.size()), bvh_node_count = uint(bvh_.nodes.size());
    float ray_epsilon = scene_.ray_epsilon(), scene_size = scene_.size();
    bool has_followed = bvh_node_count > 0, follows_through = has_followed;
    bool has_direct = bvh_node_count > 0 && !map_.settings.direct_in_photons;
};

/// The estimate for tests and the probe.
using PhotonEstimator = GatherText<Uncounted>;

}  // namespace lw
