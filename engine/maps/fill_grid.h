// The photons that one patch refers to, brought into its frame, packed and sorted by the cells of its grid.
#pragma once
#include <span>

#include "maps/photon_map.h"
#include "photons/photon.h"

namespace lw {

constexpr double references_per_cell = 2.5;  // mean number of references in a cell

/// What a grid was filled with.
struct FilledGrid {
    std::vector<uint> cell_starts;  // where the records of each cell start
    std::vector<uint> photons;      // of each record, in their order: the index of its photon
};

/// Fits the grid, which has the frame of its patch and its radius, to the photons `chosen` by index, and writes their
/// records into the arrays of `records`, which have room, from `begin` on; flux is multiplied by its scale.
/// grid.first_cell is left to the caller.
FilledGrid fill_grid(SurfaceGrid& grid, const std::vector<Photon>& photons, std::span<const uint> chosen, uint begin,
                     PhotonRecords& records);

}  // namespace lw
