#include "file/map_checks.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace lw {
namespace {

constexpr float max_metres = 1e10f;     // beyond it, shaders may compute infinities or NaN from a position
constexpr float max_cells = 512;        // most cells across a search radius: the exact gather visits rings of them
constexpr float farthest_cell = 1e8f;   // from a grid's corner to a point of the scene: shaders count cells in ints
constexpr uint max_columns = 1u << 23;  // and rows: the shaders count them in floats

bool is_usable(const SurfaceGrid& g, float scene_size) {
    const auto place = [](vec3 v) { return is_place(v.x) && is_place(v.y) && is_place(v.z); };
    const auto axis = [](vec3 v) { return std::abs(v.x) < 2 && std::abs(v.y) < 2 && std::abs(v.z) < 2; };
    return place(g.origin) && axis(g.u_axis) && axis(g.v_axis) && axis(g.normal) && place(g.quantum) &&
           is_place(g.h_origin) && is_place(g.cell_size) && g.cell_size > 0 && is_place(g.radius) && g.radius > 0 &&
           g.radius <= max_cells * g.cell_size && length(g.origin) + scene_size <= farthest_cell * g.cell_size &&
           g.columns <= max_columns && g.rows <= max_columns;
}

bool is_usable_cut(const SurfaceGrid& g) {
    return is_place(length(g.origin)) && std::abs(g.normal.x) < 2 && std::abs(g.normal.y) < 2 &&
           std::abs(g.normal.z) < 2 && g.lattice.columns == 0 && g.lattice.rows == 0;
}

void check_grids(const std::filesystem::path& path, const std::vector<SurfaceGrid>& records,
                 const std::vector<uint>& cell_starts, const Scene& scene) {
    uint64_t cells = 0;
    for (size_t i = 0; i < records.size(); ++i) {
        const SurfaceGrid& g = records[i];
        const uint64_t here = uint64_t(g.columns) * g.rows;
        if (is_cut(g) && is_usable_cut(g)) continue;
        if (!is_usable(g, scene.size()) || here == 0 || g.first_cell != cells || here > cell_starts.size() - cells)
            refuse(path, "grid " + std::to_string(i) + " is not valid");
        cells += here;
    }
    if (cells + 1 != cell_starts.size()) refuse(path, "cells and grids do not agree");
    if (cell_starts.front() != 0) refuse(path, "its first cell does not start with the first reference");
    for (size_t c = 0; c + 1 < cell_starts.size(); ++c)
        if (cell_starts[c] > cell_starts[c + 1]) refuse(path, "cell " + std::to_string(c) + " ends before it starts");
}

/// Checks that every cut among the records [first, last) leads to later cuts or to grids, and that no way through the
/// cuts is too long.
void check_cuts(const std::filesystem::path& path, const std::vector<SurfaceGrid>& records, size_t first, size_t last) {
    std::vector<uint> deep(last - first, 0);  // the longest way from each cut, in cuts
    for (size_t i = last; i-- > first;) {
        const SurfaceGrid& cut = records[i];
        if (!is_cut(cut)) continue;
        if (i + 1 < last && !is_cut(records[i + 1]))
            refuse(path, "grid " + std::to_string(i + 1) + " comes after cuts");
        for (uint next : {cut.rows, cut.first_cell}) {
            if (next == no_grid) continue;
            if (next < first || next >= last || (is_cut(records[next]) && next <= i))
                refuse(path, "cut " + std::to_string(i) + " leads to grid " + std::to_string(next));
            deep[i - first] = std::max(deep[i - first], deep[next - first] + 1);
        }
        if (deep[i - first] > max_cuts_deep) refuse(path, "cut " + std::to_string(i) + " leads too deep");
    }
}

/// Checks that every grid except those of caustics has a lattice, and that all arrays of nodes have a value per node.
void check_lattices(const std::filesystem::path& path, const PhotonMap& map) {
    uint64_t nodes = 0;
    for (size_t i = 0; i < map.grids.size() - map.caustic_grids; ++i) {
        const SurfaceLattice& l = map.grids[i].lattice;
        const auto is_step = [](float v) { return v > 0 && is_place(v); };
        if (l.columns < 2 || l.rows < 2 || l.columns > max_columns || l.rows > max_columns || l.first_node != nodes ||
            !is_step(l.step.x) || !is_step(l.step.y) || !is_place(l.low.x) || !is_place(l.low.y) ||
            uint64_t(l.columns) * l.rows > map.coverage.size() - nodes)
            refuse(path, "the lattice of grid " + std::to_string(i) + " is not valid");
        nodes += uint64_t(l.columns) * l.rows;
    }
    if (nodes != map.coverage.size()) refuse(path, "lattices and coverage do not agree");
}

/// Checks that shadow masks are in the order of cells and lamps, that these exist, and that the map has visibility
/// bits.
void check_masks(const std::filesystem::path& path, const PhotonMap& map, const Scene& scene) {
    if (map.shadow_masks.size() >= 1u << (32 - first_mask_shift) ||
        (!map.shadow_masks.empty() && !map.has_visible_lamps()))
        refuse(path, "it has more shadow masks than it may");
    for (size_t i = 0; i < map.shadow_masks.size(); ++i) {
        const ShadowMask& mask = map.shadow_masks[i];
        const auto before = [](const ShadowMask& a, const ShadowMask& b) {
            return a.cell < b.cell || (a.cell == b.cell && a.lamp < b.lamp);
        };
        if (mask.cell >= map.coverage.size() || mask.lamp >= scene.lights.size() ||
            !is_delta(scene.lights[mask.lamp].type) || (i > 0 && !before(map.shadow_masks[i - 1], mask)))
            refuse(path, "shadow mask " + std::to_string(i) + " is not valid");
    }
}

}  // namespace

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
    throw Error(path.string() + ": " + what + "; bake the map again");
}

bool is_place(float metres) { return std::abs(metres) < max_metres; }

/// True for 2^-100 to 2^100: light divided by such a scale stays finite.
bool is_scale(float scale) { return scale >= 0x1p-100f && scale <= 0x1p100f; }

void check_records(const std::filesystem::path& path, const GridRecords& file, const PhotonMap& map,
                   const Scene& scene) {
    if (map.cell_starts.empty()) refuse(path, "it has no cells");
    if (map.emitted.size() != scene.lights.size()) refuse(path, "the number of lamps does not agree with the scene");
    if (file.of_caustics > file.records.size()) refuse(path, "it has more grids of caustics than grids");
    if (file.of_side.size() != 2 * scene.triangles.size())
        refuse(path, "the number of triangles does not agree with the scene");
    if (map.fluxes.size() != map.places.size() || (map.has_directions() && map.directions.size() != map.places.size()))
        refuse(path, "the record arrays differ in length");
    check_grids(path, file.records, map.cell_starts, scene);
    if (map.cell_starts.back() != map.places.size()) refuse(path, "cells and references do not agree");
    const size_t others = file.records.size() - file.of_caustics;
    check_cuts(path, file.records, 0, others);
    check_cuts(path, file.records, others, file.records.size());
    const auto refuse_grid = [&](uint index) {
        refuse(path, "a triangle refers to grid " + std::to_string(index) + " which does not exist");
    };
    for (uint index : file.of_side)
        if (index != no_grid && index >= others) refuse_grid(index);
    for (uint word : file.caustic_sides)
        if (word != 0 && (word - 1 < others || word - 1 >= file.records.size())) refuse_grid(word - 1);
}

void check_map(const std::filesystem::path& path, PhotonMap& map, const Scene& scene) {
    const bool has_caustics = map.caustic_grids + map.caustic_cuts > 0;
    if (!map.caustic_sides.accept(has_caustics ? map.grid_of_side.size() : 0))
        refuse(path, "the number of triangles does not agree with the scene");
    for (const PhotonPlace& place : map.places)
        if (light_of(place) >= scene.lights.size())
            refuse(path, "a photon refers to lamp " + std::to_string(light_of(place)) + " which does not exist");
    check_lattices(path, map);
    if (map.has_visible_lamps() &&
        map.visible_lamps.size() != map.coverage.size() * visibility_row_length(uint(scene.lights.size())))
        refuse(path, "lattices and lamp visibility do not agree");
    if (!map.irradiance.accept(map.coverage.size() * scene.lights.size()))
        refuse(path, "lattices and irradiance do not agree");
    const size_t marks = map.caustic_grids > 0 && map.has_visible_lamps() ? (map.coverage.size() + 31) / 32 : 0;
    if (map.smooth_caustics.size() != marks) refuse(path, "lattices and marks of caustics do not agree");
    check_masks(path, map, scene);
}

}  // namespace lw
