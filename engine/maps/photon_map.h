// The photon map of a scene as plain arrays, in the layout that the file and the GPU share (shaders/photon_map.h).
#pragma once
#include <cstdint>
#include <vector>

#include "maps/sparse_array.h"
#include "shaders/photon_map.h"

namespace lw {

/// The settings of a bake. They are stored in the file.
struct BakeSettings {
    uint64_t photons = 1'000'000;    // stored photons asked for
    float radius = 0;                // m, largest search radius; 0: as the surroundings of each surface are near
    float neighbour_angle_deg = 60;  // largest angle between the normals of a photon and a patch that refers to it
    uint64_t seed = 1;
    bool direct_in_photons = false;  // direct light: from photons as in the paper, or exact by shadow rays
};

/// The photon grids of the patches of a scene, and which of them each side of a triangle lies in.
struct SurfaceGrids {
    std::vector<uint> grid_of_side;  // 2 per triangle: grid or cut of the front side, of the back side, or no_grid
    std::vector<SurfaceGrid> grids;  // one per patch
    std::vector<Cut> cuts;           // each before those it leads to

    /// Calls visit(grid) for every grid in which points of a surface lie whose grid or cut is `index`.
    template <class Visit>
    void for_each_grid(uint index, const Visit& visit) const {
        if (index == no_grid) return;
        if (!is_cut(index)) return visit(index);
        const Cut& cut = cuts[index & ~cut_bit];
        for_each_grid(cut.front, visit);
        for_each_grid(cut.back, visit);
    }

    /// The grid of a point of a surface whose grid or cut is `index`; no_grid where it has none.
    uint behind_cuts(uint index, vec3 position) const {
        while (is_cut(index)) index = behind_cut(cuts[index & ~cut_bit], position);
        return index;
    }
};

/// References to photons, sorted by grid and grid cell: those of cell c are entries cell_starts[c] .. cell_starts[c +
/// 1] - 1 of the record arrays. Flux is for intensity 1 of the photon's light: lm per cd, per lx or per cd/m2.
struct PhotonRecords {
    std::vector<uint> cell_starts;     // one per cell of all grids, and one more
    std::vector<PhotonPlace> places;   // 8 bytes per reference
    std::vector<uint> fluxes;          // RGB9E5 per reference
    std::vector<uint16_t> directions;  // octahedral direction the photon came from; empty without glossy surfaces
    float flux_scale = 1;              // record flux = flux * flux_scale, keeps RGB9E5 in range

    bool has_directions() const { return !directions.empty(); }
};

/// The photon map of a scene: grids, those of caustics last and without lattices, the photons in their cells, and what
/// the nodes of the lattices keep.
struct PhotonMap : SurfaceGrids, PhotonRecords {
    uint64_t scene_hash = 0;
    BakeSettings settings;
    uint64_t stored_photons = 0;
    std::vector<uint64_t> emitted;  // photons emitted per light
    SparseArray caustic_sides;      // when there are caustics, 2 per triangle: their grid or cut + 1, or 0
    uint caustic_grids = 0;         // how many of the grids; their photons (path_caustic) are in no other grid
    uint caustic_cuts = 0;          // how many of the cuts, the last ones

    std::vector<uint> coverage;       // per node of all lattices, see unpack_coverage()
    std::vector<uint> visible_lamps;  // which lamps the nodes see, see visibility_row_length(); empty when photons hold
                                      // all light
    SparseArray irradiance;           // of the nodes for lamp 0, lamp 1, ...: RGB9E5 of lux per unit intensity x scale
    float irradiance_scale = 1;
    std::vector<uint> smooth_caustics;     // a bit per node: its irradiance holds caustics; empty without caustics, and
                                           // when photons hold all light
    std::vector<ShadowMask> shadow_masks;  // in the order of lattice cells and lamps; empty when photons hold all light

    /// The bytes of all arrays.
    uint64_t bytes() const {
        const auto size = [](const auto&... arrays) { return (... + (uint64_t(arrays.size()) * sizeof(arrays[0]))); };
        return size(grid_of_side, grids, cuts, cell_starts, places, fluxes, directions, coverage, visible_lamps,
                    smooth_caustics, shadow_masks) +
               caustic_sides.bytes() + irradiance.bytes();
    }

    /// The grid or cut of caustics of a side of a triangle, 2 per triangle, or no_grid; only where there are caustics.
    uint caustic_grid_of(size_t side) const { return caustic_sides[side] - 1u; }
    bool holds_caustics(size_t node) const {
        return !smooth_caustics.empty() && ((smooth_caustics[node / 32] >> (node % 32)) & 1u);
    }
    /// True when the rows of lattice cells begin with a column of marks, see lattice_row_length().
    bool has_marks() const { return !smooth_caustics.empty() || !shadow_masks.empty(); }
    bool has_coverage() const { return !coverage.empty(); }
    bool has_visible_lamps() const { return !visible_lamps.empty(); }
};

}  // namespace lw
