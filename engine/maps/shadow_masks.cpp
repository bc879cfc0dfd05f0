#include "maps/shadow_masks.h"

#include <algorithm>
#include <optional>

#include "base/parallel.h"
#include "base/progress.h"
#include "maps/packing.h"
#include "maps/plane_grids.h"
#include "trace/emitter.h"

namespace lw {
namespace {

constexpr float even_tint = 0.02f;  // largest difference between colours within a mask

/// The visibility bits of the four corners of a cell for one lamp, joined: of the surroundings of the nodes, and of the
/// nodes themselves.
struct CornerBits {
    uint around = 0, own = 0;
};

class MaskRays {
  public:
    MaskRays(const Scene& scene, const RayCaster& caster, const Lattice& lattice,
             const std::vector<uint>& visible_lamps)
        : scene_(scene),
          caster_(caster),
          grids_(lattice.surfaces.grids),
          visible_lamps_(visible_lamps),
          emitters_(scene),
          planes_(scene, lattice.surfaces) {}

    std::vector<ShadowMask> masks_of(uint m) const {
        std::vector<ShadowMask> masks;
        const SurfaceLattice& lattice = grids_[m].lattice;
        if (!planes_.is_plane(m)) return masks;
        for (uint y = 0; y + 1 < lattice.rows; ++y)
            for (uint x = 0; x + 1 < lattice.columns; ++x)
                for (uint lamp = 0; lamp < scene_.lights.size(); ++lamp)
                    if (is_delta(scene_.lights[lamp].type))
                        if (const auto mask = find_mask(m, x, y, lamp)) masks.push_back(*mask);
        return masks;
    }

  private:
    CornerBits corner_bits(const SurfaceLattice& lattice, uint cell, uint lamp) const {
        const uint length = visibility_row_length(uint(scene_.lights.size()));
        CornerBits bits;
        for (uint corner : {cell, cell + 1, cell + lattice.columns, cell + lattice.columns + 1}) {
            const uint node = visible_lamps_[corner * length + visibility_column(lamp)] >> visibility_shift(lamp);
            bits.around |= node & (some_visible | some_hidden);
            bits.own |= (node >> own_shift) & (some_visible | some_hidden);
        }
        return bits;
    }

    /// The part of a lamp's light, RGB, that reaches point (i, j) of a cell's mask.
    vec3 look(uint m, vec2 cell, uint lamp, uint i, uint j) const {
        const SurfaceGrid& grid = grids_[m];
        const vec2 texel = (vec2(float(i), float(j)) + 0.5f) / float(shadow_mask_side);
        const vec3 position = point_on_lattice(grid, cell + texel, planes_.height(m));
        const auto in = emitters_.arrive(lamp, position, 0.5f, 0.5f);
        if (!in || dot(in->to_light, grid.normal) <= 0) return vec3(0);
        return caster_.transmittance(caster_.offset(position, grid.normal), in->position);
    }

    std::optional<ShadowMask> find_mask(uint m, uint x, uint y, uint lamp) const {
        const SurfaceLattice& lattice = grids_[m].lattice;
        const uint cell = lattice.first_node + y * lattice.columns + x;
        const CornerBits bits = corner_bits(lattice, cell, lamp);
        if (bits.around != (some_visible | some_hidden)) return std::nullopt;
        const vec2 corner{float(x), float(y)};
        ShadowMask mask{cell, lamp, 0, 0, pack_rgb9e5(vec3(1))};
        if (bits.own != (some_visible | some_hidden) && is_uniform(m, corner, lamp, bits.own == some_visible)) {
            if (bits.own == some_visible) mask.lit_low = mask.lit_high = ~0u;
            return mask;
        }
        vec3 least(1), most(0), sum(0);
        uint lit = 0;
        for (uint j = 0; j < shadow_mask_side; ++j)
            for (uint i = 0; i < shadow_mask_side; ++i) {
                const vec3 passed = look(m, corner, lamp, i, j);
                if (passed == vec3(0)) continue;
                (j < 4 ? mask.lit_low : mask.lit_high) |= 1u << (shadow_mask_side * (j % 4) + i);
                least = min(least, passed), most = max(most, passed), sum += passed;
                ++lit;
            }
        const vec3 spread = most - least;
        if (lit > 0 && std::max({spread.x, spread.y, spread.z}) > even_tint) return std::nullopt;
        if (lit > 0) mask.tint = pack_rgb9e5(sum / float(lit));
        return mask;
    }

    /// A test with one ray for every four points: true when all are fully lit (`lit`), or all dark.
    bool is_uniform(uint m, vec2 cell, uint lamp, bool lit) const {
        for (uint j = 0; j < shadow_mask_side; j += 2)
            for (uint i = 0; i < shadow_mask_side; i += 2)
                if (look(m, cell, lamp, i + (j / 2) % 2, j + (i / 2) % 2) != vec3(lit ? 1.0f : 0.0f)) return false;
        return true;
    }

    const Scene& scene_;
    const RayCaster& caster_;
    const std::vector<SurfaceGrid>& grids_;
    const std::vector<uint>& visible_lamps_;
    Emitters emitters_;
    PlaneGrids planes_;
};

}  // namespace

std::vector<ShadowMask> find_shadow_masks(const Scene& scene, const RayCaster& caster, const Lattice& lattice,
                                          const std::vector<uint>& visible_lamps) {
    const MaskRays rays(scene, caster, lattice, visible_lamps);
    std::vector<std::vector<ShadowMask>> of_grids(lattice.surfaces.grids.size());
    Progress progress("shadow masks", lattice.surfaces.grids.size());
    parallel_for(lattice.surfaces.grids.size(), [&](size_t m) {
        of_grids[m] = rays.masks_of(uint(m));
        progress.step(1);
    });
    std::vector<ShadowMask> masks;
    for (const std::vector<ShadowMask>& found : of_grids) masks.insert(masks.end(), found.begin(), found.end());
    return masks;
}

}  // namespace lw
