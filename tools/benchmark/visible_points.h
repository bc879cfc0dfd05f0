// What the pixels of a view see, on the CPU: where photons are asked for.
#pragma once
#include "neighbour_search.h"
#include "scene/surface.h"
#include "trace/ray_caster.h"

namespace lw {

struct VisiblePoint {
    Surface surface;
    vec3 geometric_normal, shading_normal;  // to the viewer
    vec3 to_view;
    uint pixel;
    uint triangle;
    vec2 barycentrics;
    uint grid;  // of the seen side, or no_grid

    Query query() const { return {surface.position, geometric_normal, grid}; }
};

/// The points through pixel centres, in image order; pixels that see nothing are left out.
std::vector<VisiblePoint> visible_points(const Scene& scene, const RayCaster& caster, const PhotonMap& map,
                                         const Camera& camera, uint width, uint height);

}  // namespace lw
