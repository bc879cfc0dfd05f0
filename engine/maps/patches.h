// Which map each side of each triangle belongs to. A large triangle has a map of its own, as in the paper; small
// triangles of one object, of like orientation and in one cell of space share one, so that references per photon do
// not grow with the tessellation.
#pragma once
#include <vector>

#include "scene/scene.h"

namespace lw {

struct Patches {
    std::vector<uint> of_side;  // 2 per triangle (front, back): patch
    uint count = 0;
};

/// Groups triangle sides whose bounding box is smaller than `patch_size` metres by (object, cell of that size, one of
/// 54 normal bins); degenerate triangles follow their neighbours' bins with the normal +Y.
Patches group_triangles(const Scene& scene, float patch_size);

}  // namespace lw
