// The nodes of the lattices. A lattice lies over each patch that has a grid and does not depend on its photons
// (SurfaceLattice in shaders/photon_map.h).
#pragma once
#include <vector>

#include "maps/photon_grids.h"

namespace lw {

/// The point of a patch that a node stands for: the nearest one in projection along the grid's normal.
struct NodePoint {
    uint triangle = no_triangle;
    vec2 barycentrics{0};
    float distance2 = 1e30f;  // m2, in projection; 0 when the node lies over the surface
    float height = -1e30f;    // m, over the grid's origin; where surfaces overlap the highest is taken

    bool exists() const { return triangle != no_triangle; }
};

/// The grids of the patches, each with the lattice laid over its patch, and the points of all nodes.
struct Nodes {
    PatchGrids surfaces;
    std::vector<NodePoint> points;  // those of a lattice begin at its first_node
};

/// Lays a lattice over the patch of every grid, at most `spacing` metres between nodes. A node farther than a cell from
/// the surface has no point: no look-up ever weighs it. Throws Error beyond 2^32 nodes.
Nodes lay_nodes(const Scene& scene, const Partition& partition, PatchGrids surfaces, float spacing);

}  // namespace lw
