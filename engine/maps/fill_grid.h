// The photons that one patch refers to, brought into its frame, packed and sorted by the cells of its grid.
#pragma once
#include <span>

#include "maps/photon_map.h"
#include "photons/photon.h"

namespace lw {

constexpr double references_per_cell = 2.5;  // mean number of references in a cell

/// Fits the grid, which has the frame of its patch and its radius, to the photons `chosen` by index, and writes their
/// records into the arrays of `records`, which have room, from `begin` on; flux is multiplied by its scale. Returns
/// where the records of each cell start. grid.first_cell is left to the caller.
std::vector<uint> fill_grid(SurfaceGrid& grid, const std::vector<Photon>& photons, std::span<const uint> chosen,
                            uint begin, PhotonRecords& records);

}  // namespace lw
