#include "maps/partition.h"

#include <cmath>

#include "maps/cuts.h"

namespace lw {
namespace {

constexpr float patch_size_in_radii = 6;  // size of a patch in search radii (study: 4 to 8)

}  // namespace

Partition partition_surfaces(const Scene& scene, const BakeSettings& settings) {
    Patches patches = group_triangles(scene, patch_size_in_radii * settings.radius);
    std::vector<PatchShape> shapes = shapes_of(scene, patches);
    cut_patches(scene, settings.radius, patches, shapes);
    std::vector<float> radii = patch_radii(shapes, settings.radius, first_floor * settings.radius);
    Neighbours neighbours(shapes, radii, settings.neighbour_angle_deg, settings.radius);
    return {.patches = std::move(patches),
            .shapes = std::move(shapes),
            .radius = settings.radius,
            .neighbour_angle_deg = settings.neighbour_angle_deg,
            .radii = std::move(radii),
            .neighbours = std::move(neighbours)};
}

std::vector<float> patch_radii(const std::vector<PatchShape>& shapes, float largest, float floor, float overhang) {
    std::vector<float> radii;
    for (const PatchShape& shape : shapes) {
        const vec3 size = shape.high - shape.low;
        const float perimeter = 2 * (size.x + size.y), area = size.x * size.y;
        const float bound = (-perimeter + std::sqrt(perimeter * perimeter + 4 * overhang * lw_pi * area)) / (2 * lw_pi);
        radii.push_back(clamp(bound, std::min(floor, largest), largest));
    }
    return radii;
}

}  // namespace lw
