#include "maps/build.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "base/error.h"
#include "base/parallel.h"
#include "maps/coverage.h"
#include "maps/cuts.h"
#include "maps/irradiance.h"
#include "maps/packing.h"
#include "maps/patches.h"
#include "maps/references.h"
#include "maps/visibility.h"

namespace lw {
namespace {

constexpr float patch_size_in_radii = 6;  // size of a patch in search radii (study: 4 to 8)
constexpr double references_per_cell = 2.5;
constexpr double references_per_photon = 2.3;  // what small patches are tightened to; 2.5 is promised

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

/// What a map keeps of a photon, packed once for all maps that refer to it.
struct Record {
    vec3 position;
    uint origin, flux, direction;
};

std::vector<Record> pack_photons(const std::vector<Photon>& photons, float flux_scale, bool directions) {
    std::vector<Record> records(photons.size());
    parallel_for(
        photons.size(),
        [&](size_t i) {
            const Photon& p = photons[i];
            records[i] = {p.position, p.origin, pack_rgb9e5(p.flux * flux_scale),
                          directions ? pack_direction(p.from) : 0};
        },
        4096);
    return records;
}

/// Moves the origin to the corner of the photons' bounds and sets quantum and cells for `count` references.
void fit_grid(SurfaceGrid& grid, const std::vector<Record>& photons, const uint* first, const uint* last) {
    vec3 low(1e30f), high(-1e30f);
    for (const uint* i = first; i != last; ++i) {
        const vec3 offset = photons[*i].position - grid.origin;
        const vec3 local(dot(offset, grid.u_axis), dot(offset, grid.v_axis), dot(offset, grid.normal));
        low = min(low, local), high = max(high, local);
    }
    const vec3 reach = max(abs(grid.origin), vec3(1e-20f));
    const float floor_size = 1e-6f * std::max({reach.x, reach.y, reach.z});
    const vec3 extent = max((high - low) * 1.0001f, vec3(floor_size));
    grid.origin += grid.u_axis * low.x + grid.v_axis * low.y;
    grid.h_origin = low.z;
    grid.quantum = extent / 65535.0f;
    const auto count = double(last - first);
    const double cells = std::max(1.0, count / references_per_cell);
    double cell = std::sqrt(double(extent.x) * double(extent.y) / cells);
    // Few or coincident photons: no cells so small that a search over the radius visits thousands.
    cell = std::max({cell, double(extent.x) / cells, double(extent.y) / cells, double(grid.radius) / 256});
    grid.cell_size = float(cell);
    grid.columns = uint(std::max(1.0, std::ceil(double(extent.x) / double(grid.cell_size))));
    grid.rows = uint(std::max(1.0, std::ceil(double(extent.y) / double(grid.cell_size))));
}

PhotonPlace place_of(const Record& photon, const SurfaceGrid& grid) {
    const vec3 offset = photon.position - grid.origin;
    const vec3 local(dot(offset, grid.u_axis), dot(offset, grid.v_axis), dot(offset, grid.normal) - grid.h_origin);
    const auto step = [](float v, float quantum) {  // rounded to nearest
        const float steps = std::min(std::max(v / quantum, 0.0f), 65535.0f);
        const int below = int(steps);
        return uint(below) + (steps - float(below) >= 0.5f ? 1u : 0u);
    };
    return {step(local.x, grid.quantum.x) | step(local.y, grid.quantum.y) << 16,
            step(local.z, grid.quantum.z) | (photon.origin & 0xffffu) << 16};
}

uint cell_of(PhotonPlace place, const SurfaceGrid& grid) {
    const vec3 local = place_in_grid(place, grid);
    const uint x = std::min(uint(local.x / grid.cell_size), grid.columns - 1);
    const uint y = std::min(uint(local.y / grid.cell_size), grid.rows - 1);
    return y * grid.columns + x;
}

/// Writes the records of one map in cell order.
void fill_grid(PhotonMap& map, uint index, const std::vector<Record>& photons, const uint* first, const uint* last,
               uint begin) {
    const SurfaceGrid& grid = map.grids[index];
    const size_t count = size_t(last - first);
    std::vector<PhotonPlace> places(count);
    std::vector<uint> cells(count);
    std::vector<uint> next(grid.columns * grid.rows + 1, 0);
    for (size_t i = 0; i < count; ++i) {
        places[i] = place_of(photons[first[i]], grid);
        cells[i] = cell_of(places[i], grid);
        ++next[cells[i] + 1];
    }
    next[0] = begin;
    for (size_t c = 1; c < next.size(); ++c) next[c] += next[c - 1];
    std::copy(next.begin(), next.end() - 1, map.cell_starts.begin() + grid.first_cell);
    for (size_t i = 0; i < count; ++i) {
        const Record& photon = photons[first[i]];
        const uint slot = next[cells[i]]++;
        map.places[slot] = places[i];
        map.fluxes[slot] = photon.flux;
        if (map.has_directions()) map.directions[slot] = photon.direction;
    }
}

/// Brings the brightest photon to 2^12, so that RGB9E5 keeps 28 powers of two below it.
float flux_scale_of(const std::vector<Photon>& photons) {
    float top = 0;
    for (const Photon& p : photons) top = std::max({top, p.flux.x, p.flux.y, p.flux.z});
    return top > 0 ? std::exp2(12 - std::ceil(std::log2(top))) : 1.0f;
}

/// Drops patches without photons, numbers the others after the grids the map has, then the cuts that lead to any, which
/// are appended to `cuts`; returns the kept patches in order.
std::vector<uint> keep_lit_patches(const References& references, const Patches& patches, PhotonMap& map,
                                   std::vector<SurfaceGrid>& cuts) {
    std::vector<uint> kept, renumbered(patches.count + patches.cuts.size(), no_map);
    for (uint p = 0; p < patches.count; ++p) {
        if (references.starts[p] == references.starts[p + 1]) continue;
        renumbered[p] = uint(map.grids.size() + kept.size());
        kept.push_back(p);
    }
    std::vector<char> is_lit(patches.count + patches.cuts.size(), 0);
    for (uint p : kept) is_lit[p] = 1;
    const auto first_cut = uint(map.grids.size() + kept.size());
    for (size_t c = patches.cuts.size(); c-- > 0;)
        is_lit[patches.count + c] = is_lit[patches.cuts[c].front] || is_lit[patches.cuts[c].back];
    for (size_t c = 0, next = first_cut; c < patches.cuts.size(); ++c)
        if (is_lit[patches.count + c]) renumbered[patches.count + c] = uint(next++);
    for (size_t c = 0; c < patches.cuts.size(); ++c)
        if (is_lit[patches.count + c]) {
            const PatchCut& cut = patches.cuts[c];
            cuts.push_back({});
            cuts.back().origin = cut.point, cuts.back().normal = cut.up;
            cuts.back().rows = renumbered[cut.front], cuts.back().first_cell = renumbered[cut.back];
        }
    for (uint patch : patches.of_side) map.triangle_maps.push_back(renumbered[patch]);
    return kept;
}

}  // namespace

double area_of(const Scene& scene) {
    double area = 0;
    for (const uvec3& t : scene.triangles) {
        const vec3 a = scene.positions[t.x];
        area += 0.5 * double(length(cross(scene.positions[t.y] - a, scene.positions[t.z] - a)));
    }
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
    constexpr double most_discs = 4e6;  // of this radius, on all surfaces: 400 million samples of their coverage
    const double least = std::sqrt(area_of(scene) / (double(lw_pi) * most_discs));
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
                    20000) < references_per_photon)
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

/// Appends the grids of a set of photons and which triangles they belong to; returns the patch of each grid.
std::vector<uint> append_grids(const Scene& scene, const RayCaster& caster, const Partition& partition,
                               const std::vector<Photon>& photons, PhotonMap& map) {
    const References references = find_references({scene, photons, partition.patches, partition.shapes, partition.radii,
                                                   map.settings.neighbour_angle_deg, partition.neighbours, caster});
    std::vector<SurfaceGrid> cuts;
    const std::vector<uint> kept = keep_lit_patches(references, partition.patches, map, cuts);
    const size_t first_grid = map.grids.size(), first_place = map.places.size();
    const auto first = [&](size_t m) { return references.photons.data() + references.starts[kept[m]]; };
    const auto last = [&](size_t m) { return references.photons.data() + references.starts[kept[m] + 1]; };

    const bool directions = needs_directions(scene);
    const std::vector<Record> records = pack_photons(photons, map.flux_scale, directions);
    map.grids.resize(first_grid + kept.size());
    parallel_for(kept.size(), [&](size_t m) {
        map.grids[first_grid + m] = frame_of(partition.shapes[kept[m]], partition.radii[kept[m]]);
        fit_grid(map.grids[first_grid + m], records, first(m), last(m));
    });
    uint64_t cells = map.cell_starts.empty() ? 0 : map.cell_starts.size() - 1;
    for (size_t g = first_grid; g < map.grids.size(); ++g) {
        map.grids[g].first_cell = uint(cells);
        cells += uint64_t(map.grids[g].columns) * map.grids[g].rows;
    }
    if (cells >= no_map) throw Error("photon map: more than 2^32 cells; use fewer photons");
    const size_t end = first_place + references.photons.size();
    map.cell_starts.resize(cells + 1);
    map.cell_starts.back() = uint(end);
    map.places.resize(end);
    map.fluxes.resize(end);
    if (directions) map.directions.resize(end);
    parallel_for(kept.size(), [&](size_t m) {
        fill_grid(map, uint(first_grid + m), records, first(m), last(m),
                  uint(first_place + references.starts[kept[m]]));
    });
    map.grids.insert(map.grids.end(), cuts.begin(), cuts.end());
    return kept;
}

/// Lays the lattices and computes what their nodes keep. All lengths follow the largest radius R: nodes every 0.5 R, a
/// sample every 0.03 R2 (26 under a kernel of R/2).
void add_lattices(const Scene& scene, const RayCaster& caster, const Partition& partition,
                  const std::vector<uint>& kept, PhotonMap& map) {
    const float radius = map.settings.radius;
    std::vector<PatchShape> shapes;
    for (uint patch : kept) shapes.push_back(partition.shapes[patch]);
    shapes.resize(map.grids.size());  // cuts have none
    const std::vector<NodePoint> nodes = lay_lattices(scene, shapes, 0.5f * radius, map);
    const std::vector<Photon> samples =
        sample_surfaces(scene, caster, partition.patches, 0.03f * radius * radius, clearance_of(radius));
    const References references = find_references({scene, samples, partition.patches, partition.shapes, partition.radii,
                                                   map.settings.neighbour_angle_deg, partition.neighbours, caster});
    if (!map.settings.direct_in_photons) map.visible_lamps = find_visibility(scene, caster, map, nodes);
    map.coverage = find_coverage(scene, map, nodes, samples, references, kept);
    map.irradiance = find_irradiance(scene, caster, map, nodes, map.irradiance_scale);
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
        if (p.path() == path_caustic) caustic.push_back(p);
    if (!caustic.empty())
        std::copy_if(photons.records.begin(), photons.records.end(), std::back_inserter(others),
                     [](const Photon& p) { return p.path() != path_caustic; });
    const std::vector<uint> kept =
        append_grids(scene, caster, partition, caustic.empty() ? photons.records : others, map);
    add_lattices(scene, caster, partition, kept, map);
    const size_t others_end = map.grids.size();
    if (!caustic.empty()) append_grids(scene, caster, partition, caustic, map);
    map.caustic_grids = uint(map.grids.size() - others_end);
    return map;
}

}  // namespace lw
