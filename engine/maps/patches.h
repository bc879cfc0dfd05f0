// Which patch each side of each triangle belongs to. A large triangle is a patch of its own, as in the paper; small
// triangles of one object, of like orientation, in one cell of space and of one sheet share one, so that references per
// photon do not grow with the tessellation.
#pragma once
#include <vector>

#include "scene/scene.h"
#include "shaders/photon_map.h"

namespace lw {

struct Patches {
    std::vector<uint> of_side;  // 2 per triangle (front, back): patch or cut
    uint count = 0;
    std::vector<Cut> cuts{};  // each before those it leads to

    /// The patch of a point of a triangle side, after cuts.
    uint at(size_t side, vec3 position) const {
        uint id = of_side[side];
        while (is_cut(id)) id = behind_cut(cuts[id & ~cut_bit], position);
        return id;
    }
};

/// Where a patch lies: a box in its own frame, anchored at a corner of one of its triangles.
struct PatchShape {
    vec3 anchor{0};
    vec3 u_axis{1, 0, 0}, v_axis{0, 0, 1}, normal{0, 1, 0};  // orthonormal; normal is the mean over its triangles
    vec3 low{0}, high{0};                                    // bounds in that frame, relative to the anchor
    vec3 box_low{0}, box_high{0};                            // bounds in the scene's axes
    uint triangle = 0;                                       // one of its triangles
    uint triangles = 0;                                      // how many it has
    float cos_spread = 1;         // least cosine between `normal` and the normals of its triangles
    std::vector<vec2> outline{};  // only of a piece of a cut patch: corners in u and v, m, convex, counter-clockwise

    /// A point of the scene in that frame, and back.
    vec3 to_local(vec3 p) const { return {dot(p - anchor, u_axis), dot(p - anchor, v_axis), dot(p - anchor, normal)}; }
    vec3 to_scene(vec3 p) const { return anchor + u_axis * p.x + v_axis * p.y + normal * p.z; }
};

/// Patches with the shape of each, and its scale: the length, m, that all sizes on it follow.
struct ScaledPatches {
    Patches patches;
    std::vector<PatchShape> shapes;
    std::vector<float> scales;
};

/// The shape of each patch.
std::vector<PatchShape> shapes_of(const Scene& scene, const Patches& patches);

/// Groups of triangle sides, and the scale of each, m.
struct SideGroups {
    Patches patches;
    std::vector<float> scales;
};

constexpr float patch_size_in_scales = 6;  // of a scale that is given (study: 4 to 8)

/// The bin of a direction: one of 54, 3 x 3 on each face of a cube. Axis-aligned normals lie in the centres of bins.
uint normal_bin(vec3 n);

/// True for a triangle that is longer than a patch but so narrow that it shares one.
inline bool is_needle(float twice_area, float longest, float patch_size) {
    return twice_area < patch_size * longest / 64;
}

/// Splits each group into sheets, such as the boards of a shelf: where the heights of its triangles leave a gap, a new
/// sheet begins.
SideGroups split_sheets(const Scene& scene, const SideGroups& grouped);

/// Groups triangle sides whose bounding box is smaller than `patch_size` metres by (object, cell of that size, one of
/// 54 normal bins), and needles that are longer but narrower than 1/64 of it, by cells of their length; degenerate
/// triangles follow their neighbours' bins with the normal +Y.
Patches group_triangles(const Scene& scene, float patch_size);

}  // namespace lw
