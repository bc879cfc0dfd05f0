#include "maps/photon_grids.h"

#include "base/error.h"
#include "base/parallel.h"
#include "maps/fill_grid.h"

namespace lw {
namespace {

/// A grid with the frame of its patch; fill_grid() sets origin and sizes.
SurfaceGrid frame_of(const PatchShape& shape, float radius) {
    SurfaceGrid grid{};
    grid.normal = shape.normal;
    grid.u_axis = shape.u_axis;
    grid.v_axis = shape.v_axis;
    grid.origin = shape.anchor;
    grid.radius = radius;
    return grid;
}

/// Gives numbers to the patches that refer to photons, which become grids, and to the cuts that lead to any of them.
PatchGrids number_lit_patches(const References& references, const Patches& patches) {
    PatchGrids lit;
    std::vector<uint> grid_of_patch(patches.count, no_grid), renumbered_cuts(patches.cuts.size(), no_grid);
    for (uint p = 0; p < patches.count; ++p) {
        if (references.starts[p] == references.starts[p + 1]) continue;
        grid_of_patch[p] = uint(lit.patches.size());
        lit.patches.push_back(p);
    }
    const auto renumbered = [&](uint id) { return is_cut(id) ? renumbered_cuts[id & ~cut_bit] : grid_of_patch[id]; };
    std::vector<char> is_lit(patches.cuts.size(), 0);
    const auto leads_to_light = [&](uint id) {
        return is_cut(id) ? is_lit[id & ~cut_bit] != 0 : grid_of_patch[id] != no_grid;
    };
    for (size_t c = patches.cuts.size(); c-- > 0;)  // cuts lead to later ones only, which must be known first
        is_lit[c] = leads_to_light(patches.cuts[c].front) || leads_to_light(patches.cuts[c].back);
    for (size_t c = 0, next = 0; c < patches.cuts.size(); ++c)
        if (is_lit[c]) renumbered_cuts[c] = uint(next++) | cut_bit;
    for (size_t c = 0; c < patches.cuts.size(); ++c)
        if (is_lit[c]) {
            const Cut& cut = patches.cuts[c];
            lit.cuts.push_back({cut.point, renumbered(cut.front), cut.normal, renumbered(cut.back)});
        }
    lit.grid_of_side.reserve(patches.of_side.size());
    for (uint id : patches.of_side) lit.grid_of_side.push_back(renumbered(id));
    return lit;
}

/// Joins the cell starts of all grids to one array, and sets first_cell of each grid.
void join_cells(const std::vector<std::vector<uint>>& starts, PhotonGrids& grids) {
    uint64_t cells = 0;
    for (size_t m = 0; m < starts.size(); ++m) {
        grids.surfaces.grids[m].first_cell = uint(cells);
        cells += starts[m].size();
    }
    if (cells >= no_grid) throw Error("photon map: more than 2^32 cells; use fewer photons");
    std::vector<uint>& joined = grids.records.cell_starts;
    joined.reserve(cells + 1);
    for (const std::vector<uint>& part : starts) joined.insert(joined.end(), part.begin(), part.end());
    joined.push_back(uint(grids.records.places.size()));
}

}  // namespace

PhotonGrids sort_into_grids(const ReferenceInput& input, RecordSettings settings) {
    const References references = find_references(input);
    PhotonGrids grids{number_lit_patches(references, input.partition.patches), {}};
    const std::vector<uint>& lit = grids.surfaces.patches;
    grids.records.flux_scale = settings.flux_scale;
    grids.records.places.resize(references.photons.size());
    grids.records.fluxes.resize(references.photons.size());
    if (settings.directions) grids.records.directions.resize(references.photons.size());
    grids.surfaces.grids.resize(lit.size());
    std::vector<std::vector<uint>> starts(lit.size());
    parallel_for(lit.size(), [&](size_t m) {
        SurfaceGrid& grid = grids.surfaces.grids[m];
        grid = frame_of(input.partition.shapes[lit[m]], input.partition.radii[lit[m]]);
        const uint64_t first = references.starts[lit[m]], last = references.starts[lit[m] + 1];
        starts[m] = fill_grid(grid, input.photons, {references.photons.data() + first, last - first}, uint(first),
                              grids.records);
    });
    join_cells(starts, grids);
    return grids;
}

std::vector<uint> append_grids(PhotonGrids more, SurfaceGrids& grids, PhotonRecords& records) {
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    const auto first_grid = uint(grids.grids.size()), first_cut = uint(grids.cuts.size());
    const auto renumbered = [&](uint id) {
        return id == no_grid ? no_grid : id + (is_cut(id) ? first_cut : first_grid);
    };
    if (!records.cell_starts.empty()) records.cell_starts.pop_back();  // the end of the last cell
    const uint64_t first_cell = records.cell_starts.size(), first_record = records.places.size();
    if (first_cell + more.records.cell_starts.size() > no_grid || first_record + more.records.places.size() > no_grid)
        throw Error("photon map: more than 2^32 cells or references; use fewer photons");
    for (SurfaceGrid& grid : more.surfaces.grids) grid.first_cell += uint(first_cell);
    for (Cut& cut : more.surfaces.cuts) cut.front = renumbered(cut.front), cut.back = renumbered(cut.back);
    for (uint& start : more.records.cell_starts) start += uint(first_record);
    append(grids.grids, more.surfaces.grids);
    append(grids.cuts, more.surfaces.cuts);
    append(records.cell_starts, more.records.cell_starts);
    append(records.places, more.records.places);
    append(records.fluxes, more.records.fluxes);
    append(records.directions, more.records.directions);
    for (uint& id : more.surfaces.grid_of_side) id = renumbered(id);
    return std::move(more.surfaces.grid_of_side);
}

}  // namespace lw
