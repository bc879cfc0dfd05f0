#include "maps/lattice.h"

#include "maps/coverage.h"

namespace lw {
namespace {

constexpr float nodes_apart = 0.5f;  // search radii between the nodes of a lattice

}  // namespace

Lattice lay_lattice(const Scene& scene, const RayCaster& caster, const Partition& partition, PatchGrids surfaces) {
    Nodes nodes = lay_nodes(scene, partition, std::move(surfaces), nodes_apart * partition.radius);
    std::vector<uint> coverage = find_coverage({scene, caster, partition, nodes});
    return {.surfaces = std::move(nodes.surfaces),
            .radius = partition.radius,
            .nodes = std::move(nodes.points),
            .coverage = std::move(coverage)};
}

}  // namespace lw
