#include "maps/build.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "base/error.h"
#include "base/parallel.h"
#include "maps/coverage.h"
#include "maps/cuts.h"
#include "maps/fill_grid.h"
#include "maps/irradiance.h"
#include "maps/patches.h"
#include "maps/plane_maps.h"
#include "maps/references.h"
#include "maps/shadow_masks.h"
#include "maps/smooth_caustics.h"
#include "maps/visibility.h"
#include "scene/triangle.h"

namespace lw {
namespace {

constexpr float patch_size_in_radii = 6;  // size of a patch in search radii (study: 4 to 8)
constexpr float nodes_apart = 0.5f;       // search radii between the nodes of a lattice
constexpr double max_references = 2.3;    // per photon, what small patches are tightened to; 2.5 is promised

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

/// Brings the brightest photon to 2^12, so that RGB9E5 keeps 28 powers of two below it.
float flux_scale_of(const std::vector<Photon>& photons) {
    float top = 0;
    for (const Photon& p : photons) top = std::max({top, p.flux.x, p.flux.y, p.flux.z});
    return top > 0 ? std::exp2(12 - std::ceil(std::log2(top))) : 1.0f;
}

/// The maps of a set of photons.
struct LitPatches {
    std::vector<uint> kept;     // their patches, in order
    std::vector<Cut> cuts;      // that lead to any of them
    std::vector<uint> of_side;  // the map or cut of each side of a triangle, or no_map
};

/// Drops patches without photons and numbers the others after the grids the map has, and the cuts that lead to any
/// after its cuts.
LitPatches keep_lit_patches(const References& references, const Patches& patches, const PhotonMap& map) {
    LitPatches lit;
    std::vector<uint> grid_of_patch(patches.count, no_map), renumbered_cuts(patches.cuts.size(), no_map);
    for (uint p = 0; p < patches.count; ++p) {
        if (references.starts[p] == references.starts[p + 1]) continue;
        grid_of_patch[p] = uint(map.grids.size() + lit.kept.size());
        lit.kept.push_back(p);
    }
    const auto renumbered = [&](uint id) { return is_cut(id) ? renumbered_cuts[id & ~cut_bit] : grid_of_patch[id]; };
    std::vector<char> is_lit(patches.cuts.size(), 0);
    const auto leads_to_light = [&](uint id) {
        return is_cut(id) ? is_lit[id & ~cut_bit] != 0 : grid_of_patch[id] != no_map;
    };
    for (size_t c = patches.cuts.size(); c-- > 0;)  // those it leads to first
        is_lit[c] = leads_to_light(patches.cuts[c].front) || leads_to_light(patches.cuts[c].back);
    for (size_t c = 0, next = map.cuts.size(); c < patches.cuts.size(); ++c)
        if (is_lit[c]) renumbered_cuts[c] = uint(next++) | cut_bit;
    for (size_t c = 0; c < patches.cuts.size(); ++c)
        if (is_lit[c]) {
            const Cut& cut = patches.cuts[c];
            lit.cuts.push_back({cut.point, renumbered(cut.front), cut.normal, renumbered(cut.back)});
        }
    for (uint id : patches.of_side) lit.of_side.push_back(renumbered(id));
    return lit;
}

}  // namespace

double area_of(const Scene& scene) {
    double area = 0;
    for (size_t t = 0; t < scene.triangles.size(); ++t) area += triangle_area(scene, t);
    return area;
}

float automatic_radius(const Scene& scene, uint64_t photons) {
    const double area = area_of(scene);
    const float half_diagonal = 0.5f * length(scene.bounds[1] - scene.bounds[0]);
    const double wanted = std::sqrt(250 * area / (double(lw_pi) * double(std::max<uint64_t>(photons, 1))));
    return std::min(float(wanted), half_diagonal);
}

/// Refuses a radius so small that the lattices, which follow it, would take hours and all the memory.
void check_radius(const Scene& scene, float radius) {
    constexpr double max_discs = 4e6;  // of this radius, on all surfaces: 400 million samples of their coverage
    const double least = std::sqrt(area_of(scene) / (double(lw_pi) * max_discs));
    if (double(radius) >= least) return;
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", least);
    throw Error(scene.path.filename().string() + ": the radius is too small for the scene; give at least " + text +
                " m or auto");
}

bool needs_directions(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
        return m.metallic > 0 || m.specular > 0 || m.normal_texture.texture >= 0;
    });
}

namespace {

/// The patches for one largest radius, and a radius for each: small patches get a smaller one until references per
/// photon stay below the bound.
struct Partition {
    static constexpr float largest_floor = 0.5f;  // of the radius

    Partition(const Scene& scene, const RayCaster& caster, const Photons& photons, const BakeSettings& settings)
        : patches(group_triangles(scene, patch_size_in_radii * settings.radius)),
          shapes(cut_shapes(scene, settings.radius, patches)),
          neighbours(shapes, patch_radii(shapes, settings.radius, largest_floor * settings.radius),
                     settings.neighbour_angle_deg, settings.radius) {
        float floor = largest_floor * settings.radius;
        for (int tries = 0; tries < 16; ++tries, floor *= 0.75f) {
            radii = patch_radii(shapes, settings.radius, floor);
            if (sample_references(
                    {scene, photons.records, patches, shapes, radii, settings.neighbour_angle_deg, neighbours, caster},
                    20000) < max_references)
                break;
        }
    }
    static std::vector<PatchShape> cut_shapes(const Scene& scene, float radius, Patches& patches) {
        std::vector<PatchShape> shapes = shapes_of(scene, patches);
        cut_patches(scene, radius, patches, shapes);
        return shapes;
    }
    Patches patches;
    std::vector<PatchShape> shapes;
    Neighbours neighbours;
    std::vector<float> radii;
};

/// Appends the cells of the grids from `first_grid` on: starts[i] are those of grid first_grid + i.
void append_cells(const std::vector<std::vector<uint>>& starts, size_t first_grid, PhotonMap& map) {
    if (!map.cell_starts.empty()) map.cell_starts.pop_back();  // the end of the last cell
    uint64_t cells = map.cell_starts.size();
    for (size_t i = 0; i < starts.size(); ++i) {
        map.grids[first_grid + i].first_cell = uint(cells);
        cells += starts[i].size();
    }
    if (cells >= no_map) throw Error("photon map: more than 2^32 cells; use fewer photons");
    map.cell_starts.reserve(cells + 1);
    for (const std::vector<uint>& part : starts)
        map.cell_starts.insert(map.cell_starts.end(), part.begin(), part.end());
    map.cell_starts.push_back(uint(map.places.size()));
}

/// Appends the grids of a set of photons, and its cuts.
LitPatches append_grids(const Scene& scene, const RayCaster& caster, const Partition& partition,
                        const std::vector<Photon>& photons, PhotonMap& map) {
    const References references = find_references({scene, photons, partition.patches, partition.shapes, partition.radii,
                                                   map.settings.neighbour_angle_deg, partition.neighbours, caster});
    LitPatches lit = keep_lit_patches(references, partition.patches, map);
    const std::vector<uint>& kept = lit.kept;
    const size_t first_grid = map.grids.size(), first_place = map.places.size();
    const size_t end = first_place + references.photons.size();
    map.grids.resize(first_grid + kept.size());
    map.places.resize(end);
    map.fluxes.resize(end);
    if (needs_directions(scene)) map.directions.resize(end);
    std::vector<std::vector<uint>> starts(kept.size());
    parallel_for(kept.size(), [&](size_t m) {
        SurfaceGrid& grid = map.grids[first_grid + m];
        grid = frame_of(partition.shapes[kept[m]], partition.radii[kept[m]]);
        const uint64_t first = references.starts[kept[m]], last = references.starts[kept[m] + 1];
        starts[m] =
            fill_grid(grid, photons, {references.photons.data() + first, last - first}, uint(first_place + first), map);
    });
    append_cells(starts, first_grid, map);
    map.cuts.insert(map.cuts.end(), lit.cuts.begin(), lit.cuts.end());
    return lit;
}

/// The coverage of all nodes: in closed form where the ground is plane, from samples elsewhere, one every 0.03 R2 (26
/// under a kernel of R/2).
std::vector<uint> find_coverage(const Scene& scene, const RayCaster& caster, const Partition& partition,
                                const std::vector<uint>& kept, const std::vector<NodePoint>& nodes,
                                const PhotonMap& map) {
    const float radius = map.settings.radius;
    std::vector<CoverageLevels> coverage(nodes.size(), CoverageLevels{1, 1, 1, 1});
    std::vector<std::vector<uint>> others(kept.size());
    parallel_for(kept.size(), [&](size_t m) {
        const SurfaceLattice& lattice = map.grids[m].lattice;
        const PatchShape& shape = partition.shapes[kept[m]];
        if (!shape.outline.empty()) {  // walls stand around it
            for (uint i = 0; i < lattice.columns * lattice.rows; ++i)
                if (nodes[lattice.first_node + i].exists()) others[m].push_back(i);
            return;
        }
        find_flat_coverage(scene, caster, map, m, shape, &nodes[lattice.first_node], &coverage[lattice.first_node],
                           others[m]);
    });
    WantedSamples wanted{partition.patches, partition.neighbours, std::vector<char>(partition.patches.count, 0),
                         Neighbourhoods(1.01f * radius)};
    for (size_t m = 0; m < kept.size(); ++m) {
        wanted.is_wanted[kept[m]] = !others[m].empty();
        const SurfaceLattice& lattice = map.grids[m].lattice;
        for (uint i : others[m])
            wanted.neighbourhoods.add(point_on_lattice(map.grids[m],
                                                       vec2(float(i % lattice.columns), float(i / lattice.columns)),
                                                       nodes[lattice.first_node + i].height));
    }
    const std::vector<Photon> samples =
        sample_surfaces(scene, caster, wanted, 0.03f * radius * radius, clearance_of(radius));
    const References references = find_references({scene, samples, partition.patches, partition.shapes, partition.radii,
                                                   map.settings.neighbour_angle_deg, partition.neighbours, caster});
    sample_coverage(map, nodes, samples, references, kept, others, coverage);
    return pack_coverage(coverage);
}

/// Lays the lattices, nodes every half of the largest radius, and computes what their nodes keep but for their light;
/// returns their points.
std::vector<NodePoint> add_lattices(const Scene& scene, const RayCaster& caster, const Partition& partition,
                                    const std::vector<uint>& kept, PhotonMap& map) {
    std::vector<PatchShape> shapes;
    for (uint patch : kept) shapes.push_back(partition.shapes[patch]);
    std::vector<NodePoint> nodes = lay_lattices(scene, shapes, nodes_apart * map.settings.radius, map);
    if (!map.settings.direct_in_photons) {
        map.visible_lamps = find_visibility(scene, caster, map, nodes);
        map.shadow_masks = find_shadow_masks(scene, caster, map);
    }
    map.coverage = find_coverage(scene, caster, partition, kept, nodes, map);
    return nodes;
}

}  // namespace

PhotonMap build_photon_map(const Scene& scene, const RayCaster& caster, const Photons& photons, BakeSettings settings) {
    if (settings.radius > 0 && !photons.records.empty())
        check_radius(scene, settings.radius);
    else if (!(settings.radius > 0))
        settings.radius = automatic_radius(scene, photons.records.size());
    settings.radius = std::min(settings.radius, scene.size());  // nothing is farther
    PhotonMap map;
    map.scene_hash = scene.content_hash;
    map.settings = settings;
    map.stored_photons = photons.records.size();
    map.flux_scale = flux_scale_of(photons.records);
    for (const LightBalance& light : photons.lights) map.emitted.push_back(light.emitted);

    const Partition partition(scene, caster, photons, settings);
    std::vector<Photon> caustic, others;
    for (const Photon& p : photons.records)
        if (is_caustic(p.path())) caustic.push_back(p);
    if (!caustic.empty())
        std::copy_if(photons.records.begin(), photons.records.end(), std::back_inserter(others),
                     [](const Photon& p) { return !is_caustic(p.path()); });
    LitPatches lit = append_grids(scene, caster, partition, caustic.empty() ? photons.records : others, map);
    map.triangle_maps = std::move(lit.of_side);
    const std::vector<NodePoint> nodes = add_lattices(scene, caster, partition, lit.kept, map);
    std::vector<uint> irradiance = find_irradiance(scene, caster, map, nodes, map.irradiance_scale);
    if (!caustic.empty()) {
        const size_t others_end = map.grids.size(), other_cuts = map.cuts.size();
        LitPatches caustics = append_grids(scene, caster, partition, caustic, map);
        for (uint& grid : caustics.of_side) ++grid;  // none: 0
        map.caustic_sides = SparseArray(caustics.of_side);
        map.caustic_grids = uint(map.grids.size() - others_end);
        map.caustic_cuts = uint(map.cuts.size() - other_cuts);
        if (map.has_visible_lamps()) map.smooth_caustics = add_smooth_caustics(scene, nodes, map, irradiance);
    }
    map.irradiance = SparseArray(irradiance);
    return map;
}

}  // namespace lw
