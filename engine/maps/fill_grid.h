// Fills the grid of one patch: photons are transformed to its frame, packed, and sorted by cell.
#pragma once
#include <span>

#include "maps/photon_map.h"
#include "photons/photon.h"

namespace lw {

constexpr double references_per_cell = 2.5;  // mean number of references in a cell

/// Fits origin, size and cells of a grid to its photons and writes their records. `grid` has the frame and radius of
/// its patch; its first_cell is set by the caller later. `chosen`: indices of the photons. The records go to the arrays
/// of `records` from index `begin` on, which must be long enough; flux is multiplied by records.flux_scale. Returns the
/// index of the first record of each cell, row by row.
std::vector<uint> fill_grid(SurfaceGrid& grid, const std::vector<Photon>& photons, std::span<const uint> chosen,
                            uint begin, PhotonRecords& records);

}  // namespace lw
