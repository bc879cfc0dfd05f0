#include "maps/photon_grids.h"

#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"
#include "maps/fill_grid.h"
#include "scene/triangle.h"
#include "trace/sampling.h"

namespace lw {
namespace {

/// The grid in the frame of its patch; origin and sizes follow from its photons.
SurfaceGrid frame_of(const PatchShape& shape, float radius) {
    SurfaceGrid grid{};
    grid.normal = shape.normal;
    grid.u_axis = shape.u_axis;
    grid.v_axis = shape.v_axis;
    grid.origin = shape.anchor;
    grid.radius = radius;
    return grid;
}

/// Which patches refer to photons.
std::vector<char> patches_with_photons(const References& references) {
    std::vector<char> lit;
    for (size_t p = 0; p + 1 < references.starts.size(); ++p)
        lit.push_back(references.starts[p] < references.starts[p + 1]);
    return lit;
}

/// Points of a patch and the normal of its side.
struct Viewpoints {
    std::vector<vec3> points;
    vec3 normal;
};

/// The middle of a patch, or of one of its triangles, and places near its corners.
Viewpoints viewpoints_on(const Scene& scene, const PatchShape& shape) {
    constexpr float from_corner = 0.15f;  // of the way to the middle
    const std::array<vec3, 3> p = triangle_corners(scene, shape.triangle);
    std::vector<vec3> corners(p.begin(), p.end());
    vec3 normal = shape.normal;
    if (!shape.outline.empty()) {
        corners.clear();
        for (vec2 corner : shape.outline)
            corners.push_back(shape.to_scene(vec3(corner, 0.5f * (shape.low.z + shape.high.z))));
    } else if (const vec3 product = edge_product(p[0], p[1], p[2]); dot(product, product) > 0) {
        normal = normalize(product) * (dot(product, shape.normal) < 0 ? -1.0f : 1.0f);
    }
    vec3 middle(0);
    for (const vec3& corner : corners) middle += corner / float(corners.size());
    Viewpoints all{{middle}, normal};
    for (const vec3& corner : corners) all.points.push_back(mix(corner, middle, from_corner));
    return all;
}

/// Adds to `lit` all pieces of patches that were cut of which one was in it.
void add_sibling_pieces(const Patches& patches, std::vector<char>& lit) {
    const auto for_each_piece = [&](const auto& self, uint id, const auto& visit) -> void {
        if (!is_cut(id)) return visit(id);
        self(self, patches.cuts[id & ~cut_bit].front, visit);
        self(self, patches.cuts[id & ~cut_bit].back, visit);
    };
    for (uint id : patches.of_side) {
        if (!is_cut(id)) continue;
        bool any = false;
        for_each_piece(for_each_piece, id, [&](uint piece) { any = any || lit[piece]; });
        if (any) for_each_piece(for_each_piece, id, [&](uint piece) { lit[piece] = 1; });
    }
}

/// Adds to `lit` the patches from which a few rays meet some that were in it: small and narrow ones that no photon
/// happened to strike.
void add_seeing_patches(const ReferenceInput& in, std::vector<char>& lit) {
    constexpr uint rays = 6;  // from each point
    const std::vector<char> before = lit;
    const auto sees_light = [&](vec3 origin, vec3 direction) {
        const auto hit = in.caster.nearest(origin, direction);
        if (!hit) return false;
        const vec3 product = triangle_product(in.scene, hit->triangle);
        const uint back = dot(product, direction) > 0 ? 1 : 0;
        const vec3 place = origin + direction * hit->distance;
        return before[in.partition.patches.at(2 * size_t(hit->triangle) + back, place)] != 0;
    };
    parallel_for(
        lit.size(),
        [&](size_t p) {
            if (lit[p]) return;
            const Viewpoints from = viewpoints_on(in.scene, in.partition.shapes[p]);
            const mat3 frame = frame_around(from.normal);
            for (size_t i = 0; i < rays * from.points.size() && !lit[p]; ++i) {
                const vec3 direction = sample_cosine(sobol_owen(uint(i), 0, 1), sobol_owen(uint(i), 1, 1));
                lit[p] =
                    sees_light(in.caster.offset(from.points[i % from.points.size()], from.normal), frame * direction);
            }
        },
        64);
}

/// Numbers the lit patches, and the cuts that lead to any of them.
PatchGrids number_patches(const std::vector<char>& is_lit_patch, const Patches& patches) {
    PatchGrids lit;
    std::vector<uint> grid_of_patch(patches.count, no_grid), renumbered_cuts(patches.cuts.size(), no_grid);
    for (uint p = 0; p < patches.count; ++p) {
        if (!is_lit_patch[p]) continue;
        grid_of_patch[p] = uint(lit.patches.size());
        lit.patches.push_back(p);
    }
    const auto renumbered = [&](uint id) { return is_cut(id) ? renumbered_cuts[id & ~cut_bit] : grid_of_patch[id]; };
    std::vector<char> is_lit(patches.cuts.size(), 0);
    const auto leads_to_light = [&](uint id) {
        return is_cut(id) ? is_lit[id & ~cut_bit] != 0 : grid_of_patch[id] != no_grid;
    };
    for (size_t c = patches.cuts.size(); c-- > 0;)  // those it leads to first
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

/// Joins the starts of the cells of all grids, and tells each grid its first.
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
    std::vector<char> patches = patches_with_photons(references);
    if (settings.empty_grids) {
        add_seeing_patches(input, patches);
        add_sibling_pieces(input.partition.patches, patches);
    }
    PhotonGrids grids{number_patches(patches, input.partition.patches), {}, {}};
    const std::vector<uint>& lit = grids.surfaces.patches;
    grids.records.flux_scale = settings.flux_scale;
    grids.photons.resize(references.photons.size());
    grids.records.places.resize(references.photons.size());
    grids.records.fluxes.resize(references.photons.size());
    if (settings.directions) grids.records.directions.resize(references.photons.size());
    grids.surfaces.grids.resize(lit.size());
    std::vector<std::vector<uint>> starts(lit.size());
    parallel_for(lit.size(), [&](size_t m) {
        SurfaceGrid& grid = grids.surfaces.grids[m];
        grid = frame_of(input.partition.shapes[lit[m]], input.partition.radii[lit[m]]);
        const uint64_t first = references.starts[lit[m]], last = references.starts[lit[m] + 1];
        FilledGrid filled = fill_grid(grid, input.photons, {references.photons.data() + first, last - first},
                                      uint(first), grids.records);
        starts[m] = std::move(filled.cell_starts);
        std::copy(filled.photons.begin(), filled.photons.end(), grids.photons.begin() + int64_t(first));
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
