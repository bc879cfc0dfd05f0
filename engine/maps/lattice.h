// The static lattice of each map: nodes over its surface, whatever photons it has (shaders/photon_map.h). What a still
// scene allows to compute once is kept per node.
#pragma once
#include <vector>

#include "maps/patches.h"
#include "maps/photon_map.h"

namespace lw {

/// The point of a map's surface that a node stands for: the nearest one in projection along the map's normal.
struct NodePoint {
    uint triangle = no_map;
    vec2 barycentrics{0};
    float distance2 = 1e30f;  // m2, in projection; 0 when the node lies over the surface
    float height = -1e30f;    // m, over the grid's origin; where sheets overlap the highest is the one that is seen

    bool exists() const { return triangle != no_map; }
};

/// Lays the lattice of every map, at most `spacing` metres between nodes; shapes[m] is the shape of map m.
/// Returns the points of all nodes; a node farther than a cell from the surface has none: no look-up ever weighs
/// it.
std::vector<NodePoint> lay_lattices(const Scene& scene, const std::vector<PatchShape>& shapes, float spacing,
                                    PhotonMap& map);

}  // namespace lw
