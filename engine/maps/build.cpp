#include "maps/build.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "base/error.h"
#include "maps/irradiance.h"
#include "maps/photon_grids.h"
#include "maps/shadow_masks.h"
#include "maps/smooth_caustics.h"
#include "maps/visibility.h"
#include "scene/triangle.h"

namespace lw {

double area_of(const Scene& scene) {
    double area = 0;
    for (size_t t = 0; t < scene.triangles.size(); ++t) area += triangle_area(scene, t);
    return area;
}

namespace {

/// Refuses a radius so small that the lattices, which follow it, would take hours and all the memory.
void check_radius(const Scene& scene, float radius) {
    constexpr double max_discs = 4e6;  // most discs of this radius on all surfaces: 400 million samples of coverage
    const double least = std::sqrt(area_of(scene) / (double(lw_pi) * max_discs));
    if (double(radius) >= least) return;
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", least);
    throw Error(scene.path.filename().string() + ": the radius is too small for the scene; give at least " + text +
                " m or auto");
}

/// Brings the brightest photon to 2^12, so that RGB9E5 keeps 28 powers of two below it.
float flux_scale_of(const std::vector<Photon>& photons) {
    float top = 0;
    for (const Photon& p : photons) top = std::max({top, p.flux.x, p.flux.y, p.flux.z});
    return top > 0 ? std::exp2(12 - std::ceil(std::log2(top))) : 1.0f;
}

/// The settings with the radius that is used, if one is given.
BakeSettings with_radius(const Scene& scene, const Photons& photons, BakeSettings settings) {
    if (settings.radius > 0 && !photons.records.empty()) check_radius(scene, settings.radius);
    settings.radius = clamp(settings.radius, 0.0f, scene.size());  // nothing is farther
    return settings;
}

/// Photons that came by mirrors and glass alone, and all others.
struct PartedPhotons {
    std::vector<Photon> caustic, others;
};

PartedPhotons part_caustics(const std::vector<Photon>& photons) {
    PartedPhotons parted;
    std::partition_copy(photons.begin(), photons.end(), std::back_inserter(parted.caustic),
                        std::back_inserter(parted.others), [](const Photon& p) { return is_caustic(p.path()); });
    return parted;
}

/// Puts the grids of caustics behind those of the map.
void add_caustics(PhotonGrids caustics, PhotonMap& map) {
    map.caustic_grids = uint(caustics.surfaces.grids.size());
    map.caustic_cuts = uint(caustics.surfaces.cuts.size());
    std::vector<uint> of_side = append_grids(std::move(caustics), map, map);
    for (uint& id : of_side) ++id;  // none: 0
    map.caustic_sides = SparseArray(of_side);
}

}  // namespace

bool needs_directions(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
        return m.metallic > 0 || m.specular > 0 || m.normal_texture.texture >= 0;
    });
}

PhotonMap build_photon_map(const Scene& scene, const RayCaster& caster, const Photons& photons, BakeSettings wanted) {
    const BakeSettings settings = with_radius(scene, photons, wanted);
    const RecordSettings packing{.flux_scale = flux_scale_of(photons.records), .directions = needs_directions(scene)};
    const bool has_caustics = std::any_of(photons.records.begin(), photons.records.end(),
                                          [](const Photon& p) { return is_caustic(p.path()); });
    const PartedPhotons parted = has_caustics ? part_caustics(photons.records) : PartedPhotons();
    const std::vector<Photon>& others = has_caustics ? parted.others : photons.records;

    Partition partition = partition_surfaces(scene, caster, settings);
    if (!(settings.radius > 0))
        lower_radii(scene, photons.records, settings.direct_in_photons ? Follow::photons : Follow::surroundings,
                    partition);
    RecordSettings with_lattice = packing;
    with_lattice.empty_grids = !settings.direct_in_photons;
    PhotonGrids grids = sort_into_grids({scene, caster, partition, others}, with_lattice);
    Lattice lattice = lay_lattice(scene, caster, partition, std::move(grids.surfaces));

    std::vector<uint> visible_lamps;  // none where photons hold all light
    std::vector<ShadowMask> shadow_masks;
    if (!settings.direct_in_photons) {
        visible_lamps = find_visibility(scene, caster, lattice);
        shadow_masks = find_shadow_masks(scene, caster, lattice, visible_lamps);
    }
    PhotonGrids caustics;
    if (has_caustics) {
        if (!(settings.radius > 0)) lower_radii(scene, parted.caustic, Follow::photons, partition);
        caustics = sort_into_grids({scene, caster, partition, parted.caustic}, packing);
    }
    NodeIrradiance irradiance =
        settings.direct_in_photons
            ? smooth_irradiance(scene, lattice, grids.records)
            : gather_irradiance({scene, caster, lattice, grids, others, settings.seed, visible_lamps}, caustics);
    SmoothCaustics light{std::move(irradiance), {}};
    if (has_caustics && !settings.direct_in_photons)
        light = add_smooth_caustics(scene, lattice, caustics, std::move(light.irradiance));

    PhotonMap map;
    map.scene_hash = scene.content_hash;
    map.settings = settings;
    map.stored_photons = photons.records.size();
    for (const LightBalance& lamp : photons.lights) map.emitted.push_back(lamp.emitted);
    static_cast<SurfaceGrids&>(map) = std::move(lattice.surfaces);
    static_cast<PhotonRecords&>(map) = std::move(grids.records);
    if (has_caustics) add_caustics(std::move(caustics), map);
    map.coverage = std::move(lattice.coverage);
    map.visible_lamps = std::move(visible_lamps);
    map.shadow_masks = std::move(shadow_masks);
    map.irradiance = SparseArray(light.irradiance.records);
    map.irradiance_scale = light.irradiance.scale;
    map.smooth_caustics = std::move(light.marks);
    return map;
}

}  // namespace lw
