// The lattices over all patches that have photons, as one value: what light is computed at once, and looked up between.
#pragma once
#include <span>

#include "maps/nodes.h"

namespace lw {

struct Lattice {
    PatchGrids surfaces;           // the grids, each with its lattice
    std::vector<NodePoint> nodes;  // those of a lattice begin at its first_node
    std::vector<uint> coverage;    // of each node, see unpack_coverage()
    std::vector<char> buried;      // of each node: 1 where no light gets, as something lies on the surface
};

/// Lays a lattice over the patch of every grid, a node every half of its scale, and finds the coverage of the
/// nodes. Throws Error beyond 2^32 nodes.
Lattice lay_lattice(const Scene& scene, const RayCaster& caster, const Partition& partition, PatchGrids surfaces);

/// The place of a node in the frame of its grid, m: on the surface, or beside it at the height of the nearest point.
vec3 node_in_grid(const Lattice& lattice, const SurfaceGrid& grid, uint node);

/// Gives the buried nodes of grid m the mean light of those beside them that are not, because the surface beside what
/// buries them is interpolated between the two. `light`: of all nodes.
void fill_buried_nodes(const Lattice& lattice, uint m, std::span<vec3> light);

}  // namespace lw
