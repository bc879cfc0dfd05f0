// Sorts photons into the grids of the patches that refer to them (Graglia, Sequeira, Mavromatis, Real-Time Walkthrough
// Rendering, 2012, sections 2.1 and 2.2).
#pragma once
#include "maps/photon_map.h"
#include "maps/references.h"

namespace lw {

/// Grids, and the patch of each. Patches without photons have none.
struct PatchGrids : SurfaceGrids {
    std::vector<uint> patches;  // per grid its patch in the partition, ascending
};

/// The grids of a set of photons, numbered from 0, and the photons in their cells.
struct PhotonGrids {
    PatchGrids surfaces;
    PhotonRecords records;
};

/// How photons are stored in records.
struct RecordSettings {
    float flux_scale = 1;  // record flux = flux * flux_scale
    bool directions = false;
};

/// Makes a grid with its records for each patch that refers to photons. Throws Error beyond 2^32 references or cells.
PhotonGrids sort_into_grids(const ReferenceInput& input, RecordSettings settings);

/// Appends the grids, cuts and records of `more` to `grids` and `records`; grids.grid_of_side is unchanged. Returns
/// more.grid_of_side with the new numbers.
std::vector<uint> append_grids(PhotonGrids more, SurfaceGrids& grids, PhotonRecords& records);

}  // namespace lw
