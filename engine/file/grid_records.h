// Grids and cuts in the form of the map file (docs/map-format.md): one list of records, in which a cut is a SurfaceGrid
// without columns. No other file knows this form.
#pragma once
#include <vector>

#include "maps/photon_map.h"

namespace lw {

/// Grids, cuts and sides of triangles in the form of the file. A reference is the index of a record, or no_grid.
struct GridRecords {
    std::vector<uint> of_side;         // 2 per triangle: reference
    std::vector<uint> caustic_sides;   // per marked side of PhotonMap::caustic_sides: reference + 1
    std::vector<SurfaceGrid> records;  // grids, then the cuts that lead to them; both of caustics after these
    uint of_caustics = 0;              // number of records of caustics, the last ones
};

/// True for a record that is a cut. It keeps its point in `origin`, its normal in `normal`, and references to what lies
/// in front and behind in `rows` and `first_cell`.
inline bool is_cut(const SurfaceGrid& record) { return record.columns == 0; }

GridRecords records_of(const PhotonMap& map);

/// Moves records into the grids, cuts, grid_of_side and caustic_sides of `map`. Their references must be valid
/// (check_records()).
void take_records(GridRecords records, PhotonMap& map);

}  // namespace lw
