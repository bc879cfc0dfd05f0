// The nodes of the lattices: a static lattice over the surface of each patch that has a grid, whatever photons it has
// (SurfaceLattice of shaders/photon_map.h). What a still scene allows to compute once is kept per node.
#pragma once
#include <vector>

#include "maps/photon_grids.h"

namespace lw {

/// The point of a patch's surface that a node stands for: the nearest one in projection along the grid's normal.
struct NodePoint {
    uint triangle = no_triangle;
    vec2 barycentrics{0};
    float distance2 = 1e30f;  // m2, in projection; 0 when the node lies over the surface
    float height = -1e30f;    // m, over the grid's origin; where sheets overlap the highest is the one that is seen

    bool exists() const { return triangle != no_triangle; }
};

/// The grids of the patches, each with the lattice laid over its patch, and the points of all nodes.
struct Nodes {
    PatchGrids surfaces;
    std::vector<NodePoint> points;  // those of a lattice begin at its first_node
};

/// Lays a lattice over the patch of every grid. A node farther than a cell from the surface has no point: no look-up
/// ever weighs it. Throws Error beyond 2^32 nodes.
Nodes lay_nodes(const Scene& scene, const Partition& partition, PatchGrids surfaces);

}  // namespace lw
