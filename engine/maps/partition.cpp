#include "maps/partition.h"

#include <cmath>

#include "maps/cuts.h"
#include "maps/lattice.h"
#include "maps/local_patches.h"
#include "maps/outline.h"
#include "maps/surroundings.h"
#include "maps/tiles.h"
#include "scene/triangle.h"

namespace lw {
namespace {

constexpr float radius_in_scales = 2.5f;
constexpr float least_radius_given = 0.5f, least_radius = 0.14f;  // of the largest: those of small patches
constexpr float least_apart = 0.25f;                              // of the scale: nodes on small patches
constexpr double photons_wanted = 250;                            // within a search radius

ScaledPatches patches_of_scale(const Scene& scene, float scale) {
    Patches patches = group_triangles(scene, patch_size_in_scales * scale);
    std::vector<PatchShape> shapes = shapes_of(scene, patches);
    const size_t count = patches.count;
    return {std::move(patches), std::move(shapes), std::vector<float>(count, scale)};
}

ScaledPatches patches_of_surroundings(const Scene& scene, const RayCaster& caster) {
    ScaledPatches scaled = find_local_patches(scene, caster);
    cut_into_tiles(scene, caster, scaled);
    const ScaleRule rule(scene);
    for (size_t p = 0; p < scaled.scales.size(); ++p) {
        const vec3 size = scaled.shapes[p].high - scaled.shapes[p].low;
        scaled.scales[p] = rule.at_most(scaled.scales[p], std::max(size.x, size.y));
    }
    return scaled;
}

/// The area of each patch, m2.
std::vector<double> areas_of(const Scene& scene, const Partition& partition) {
    std::vector<double> areas(partition.patches.count, 0);
    for (size_t side = 0; side < partition.patches.of_side.size(); ++side)
        if (const uint id = partition.patches.of_side[side]; !is_cut(id)) areas[id] += triangle_area(scene, side / 2);
    for (size_t p = 0; p < areas.size(); ++p)
        if (!partition.shapes[p].outline.empty()) areas[p] = double(area_of(partition.shapes[p].outline));
    return areas;
}

}  // namespace

Partition partition_surfaces(const Scene& scene, const RayCaster& caster, const BakeSettings& settings) {
    const bool given = settings.radius > 0;
    ScaledPatches scaled = given ? patches_of_scale(scene, settings.radius) : patches_of_surroundings(scene, caster);
    cut_patches(scene, scaled);
    std::vector<float> largest = scaled.scales;
    for (float& radius : largest) radius *= given ? 1.0f : radius_in_scales;
    std::vector<float> radii = patch_radii(scaled.shapes, largest, given ? least_radius_given : least_radius);
    Neighbours neighbours(scaled.shapes, radii, settings.neighbour_angle_deg, largest);
    std::vector<float> apart = scaled.scales;
    for (size_t p = 0; p < apart.size(); ++p)
        apart[p] = clamp(0.5f * radii[p], least_apart * apart[p], nodes_apart * apart[p]);
    return {.patches = std::move(scaled.patches),
            .shapes = std::move(scaled.shapes),
            .scales = std::move(scaled.scales),
            .node_distances = std::move(apart),
            .neighbour_angle_deg = settings.neighbour_angle_deg,
            .radii = std::move(radii),
            .neighbours = std::move(neighbours)};
}

std::vector<float> patch_radii(const std::vector<PatchShape>& shapes, std::vector<float> largest, float floor) {
    for (size_t p = 0; p < shapes.size(); ++p) {
        const vec3 size = shapes[p].high - shapes[p].low;
        const float perimeter = 2 * (size.x + size.y), area = size.x * size.y, pi2 = 2 * lw_pi;
        const float bound = (-perimeter + std::sqrt(perimeter * perimeter + 2 * pi2 * max_overhang * area)) / pi2;
        largest[p] = clamp(bound, floor * largest[p], largest[p]);
    }
    return largest;
}

void lower_radii(const Scene& scene, const std::vector<Photon>& photons, Follow follow, Partition& partition) {
    const std::vector<double> areas = areas_of(scene, partition);
    std::vector<uint> counts(areas.size(), 0);
    for (const Photon& p : photons) ++counts[partition.patches.at(2 * size_t(p.triangle) + p.side(), p.position)];
    for (size_t p = 0; p < counts.size(); ++p) {
        const double dense = std::sqrt(photons_wanted * areas[p] / (double(lw_pi) * std::max(counts[p], 1u)));
        float& apart = partition.node_distances[p];
        if (follow == Follow::photons) apart = std::min(apart, 0.5f * float(dense));
        partition.radii[p] = std::min(partition.radii[p], std::max(2 * apart, float(dense)));
    }
}

}  // namespace lw
