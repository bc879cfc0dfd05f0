// Grids and cuts in the form of the map file (docs/map-format.md): one list of records, in which a cut is a
// SurfaceGrid without columns. The only place that knows this form.
#pragma once
#include <vector>

#include "maps/photon_map.h"

namespace lw {

/// What the file keeps of the grids, the cuts and the sides of triangles. A reference is the number of a record, or
/// no_grid.
struct GridRecords {
    std::vector<uint> of_side;         // 2 per triangle: reference
    std::vector<uint> caustic_sides;   // of each marked side of a map with caustics: reference + 1
    std::vector<SurfaceGrid> records;  // grids, then the cuts that lead to them; both of caustics after these
    uint of_caustics = 0;              // how many of the records are those of caustics
};

/// A cut keeps its point in `origin`, its normal, and what lies in front and behind in `rows` and `first_cell`.
inline bool is_cut(const SurfaceGrid& record) { return record.columns == 0; }

GridRecords records_of(const PhotonMap& map);

/// Moves records whose references are valid (check_records()) into `map`: its grids, cuts, sides, and the values of its
/// caustic_sides.
void take_records(GridRecords records, PhotonMap& map);

}  // namespace lw
