// The data that pixels read in the cached mode: for each lattice cell the irradiance at its corners, with all lamps at
// their present powers, and what is known of each lamp in the cell. A lattice cell is numbered by its lower left node.
// Derived from map and scene; not stored in the file.
#pragma once
#include <span>
#include <vector>

#include "maps/photon_map.h"
#include "scene/scene.h"

namespace lw {

class LatticeLight {
  public:
    /// Finds for each lattice cell which lamps its light will hold and which are left to the pixel. Scene and map must
    /// outlive it.
    LatticeLight(const Scene& scene, const PhotonMap& map);

    /// What is known in each lattice cell, lattice_row_length() numbers per cell: its marks, then bits for each lamp
    /// (shaders/photon_map.h). Empty when photons hold all light.
    const std::vector<uint>& rows() const { return rows_; }
    /// The shadow masks that cells refer to: 64 lit bits (low, high), tint (RGB9E5), unused.
    const std::vector<uvec4>& masks() const { return masks_; }
    /// The corners' irradiance, four RGB9E5 per cell of lux x the returned scale; powers: RGB power of each lamp.
    float sum(std::span<const vec3> powers, std::vector<uvec4>& light) const;
    /// What irradiance at the nodes is multiplied by in sum(), so that the brightest corner fits into RGB9E5; that of
    /// PhotonMap::irradiance not included.
    float scale_of(std::span<const vec3> powers) const;

    /// Lamps whose own light cells may hold.
    const std::vector<uint>& punctual() const { return punctual_; }
    /// Bits of floats: lux at node n from lamp punctual()[i] at intensity 1, if nothing stands between, is entry
    /// i x nodes + n; 0 at nodes of no cell that holds the lamp.
    const SparseArray& direct() const { return direct_; }

  private:
    bool holds(size_t cell, uint lamp) const;
    /// The column of the row of `cell` in which the bits of `lamp` lie.
    uint& lamp_column(size_t cell, uint lamp);
    void fill_rows(const SurfaceGrid& grid);
    void add_mask(const ShadowMask& mask);
    /// The bits of `lamp` in the cell whose lower left node is `node`, before direct light and masks are known.
    uint lamp_bits(const SurfaceLattice& lattice, uint node, uint lamp) const;
    void add_direct_of_punctuals(const SurfaceGrid& grid, float height, std::vector<uint>& direct);
    bool is_even(const SurfaceGrid& grid, uint node, uint lamp, float height) const;

    const Scene& scene_;
    const PhotonMap& map_;
    uint lamp_count_, first_lamp_column_, row_length_;
    std::vector<uint> rows_;
    std::vector<uvec4> masks_;
    uint masked_cell_ = no_grid;  // the cell of the last of them
    std::vector<uint> punctual_;
    SparseArray direct_;
    float max_direct_ = 1e-20f;
};

}  // namespace lw
