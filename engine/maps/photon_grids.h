// Photons sorted into the grids of the patches that refer to them (paper, sections 2.1 and 2.2).
#pragma once
#include "maps/photon_map.h"
#include "maps/references.h"

namespace lw {

/// Grids with the patches they are of. Patches without photons have none.
struct PatchGrids : SurfaceGrids {
    std::vector<uint> patches;  // of the partition, one per grid, ascending
};

/// The grids of a set of photons, numbered from 0, and the photons in their cells.
struct PhotonGrids {
    PatchGrids surfaces;
    PhotonRecords records;
    std::vector<uint> photons;  // of each record: which of the photons it refers to
};

/// What records keep of a photon.
struct RecordSettings {
    float flux_scale = 1;  // record flux = flux * flux_scale
    bool directions = false;
    bool empty_grids = false;  // also for patches without photons that see some that have them
};

/// One grid for each patch that refers to photons, and for those asked for, with its records; throws Error beyond 2^32
/// references or cells.
PhotonGrids sort_into_grids(const ReferenceInput& input, RecordSettings settings);

/// Appends the grids, cuts and records of `more` behind those of `grids` and `records`, whose sides keep to their own.
/// Returns the grid or cut of each side in `more`, by its new number.
std::vector<uint> append_grids(PhotonGrids more, SurfaceGrids& grids, PhotonRecords& records);

}  // namespace lw
