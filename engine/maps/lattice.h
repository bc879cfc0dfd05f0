// The lattices over all patches that have photons: points at which light is computed once, to be interpolated between.
#pragma once
#include "maps/nodes.h"

namespace lw {

struct Lattice {
    PatchGrids surfaces;           // the grids, each with its lattice
    float radius = 0;              // largest search radius, m
    std::vector<NodePoint> nodes;  // all nodes; those of a lattice begin at its first_node
    std::vector<uint> coverage;    // of each node, see unpack_coverage()
};

/// Lays a lattice over the patch of every grid, a node every half of the largest radius, and finds the coverage of the
/// nodes. Throws Error beyond 2^32 nodes.
Lattice lay_lattice(const Scene& scene, const RayCaster& caster, const Partition& partition, PatchGrids surfaces);

}  // namespace lw
