// Lists, for each part of a patch, of the other patches that may refer to photons there. They are found once, for
// coarse cells over the rectangle of every patch. So a photon is tested against the few candidates of its cell (none in
// the middle of a wall), without a search.
#pragma once
#include <span>
#include <vector>

#include "maps/patches.h"

namespace lw {

class Neighbours {
  public:
    /// `radii` are the largest that a later search uses, in metres; the cells of each patch are at most as many metres
    /// wide as `cell_sizes` says.
    Neighbours(const std::vector<PatchShape>& shapes, const std::vector<float>& radii, float neighbour_angle_deg,
               const std::vector<float>& cell_sizes);

    /// The candidates: all other patches that may refer to a photon at `position` on `patch`, and some that do not.
    std::span<const uint> near(uint patch, vec3 position) const {
        const PatchCells& c = cells_[patch];
        const uint x = place(dot(c.u_row, position) - c.low.x, c.columns);
        const uint y = place(dot(c.v_row, position) - c.low.y, c.rows);
        const uint* start = c.list.data() + 2 * (y * c.columns + x);
        return {c.list.data() + start[0], c.list.data() + start[1]};
    }

    /// The candidates of all cells of a patch; some occur more than once.
    std::span<const uint> of(uint patch) const {
        const PatchCells& c = cells_[patch];
        return std::span(c.list).subspan(2 * c.columns * c.rows);
    }

  private:
    struct PatchCells {
        vec3 u_row{0}, v_row{0};  // from positions to cells
        vec2 low{0};              // the corner of the patch, in cells
        uint columns = 0, rows = 0;
        std::vector<uint> list;  // where the candidates of each cell start and end in this list; then they

        /// Returns the size of a cell, m; its z is the height of the patch.
        vec3 divide(const PatchShape& shape, float cell_size);
        /// The candidates of cell (x, y) are those from `start` to the end of the list.
        void set_cell(uint x, uint y, size_t start) {
            list[2 * (y * columns + x)] = uint(start);
            list[2 * (y * columns + x) + 1] = uint(list.size());
        }
    };

    static uint place(float cell, uint count) { return uint(clamp(cell, 0.0f, float(count - 1))); }

    std::vector<PatchCells> cells_;
};

}  // namespace lw
