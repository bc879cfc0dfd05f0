#include "visible_points.h"

#include "scene/camera.h"

namespace lw {

std::vector<VisiblePoint> visible_points(const Scene& scene, const RayCaster& caster, const PhotonMap& map,
                                         const Camera& camera, uint width, uint height) {
    const SurfaceReader surfaces(scene);
    std::vector<VisiblePoint> points;
    for (uint pixel = 0; pixel < width * height; ++pixel) {
        const auto [origin, direction] =
            camera_ray(camera, float(pixel % width) + 0.5f, float(pixel / width) + 0.5f, int(width), int(height));
        const std::optional<Hit> hit = caster.nearest(origin, direction);
        if (!hit) continue;
        const Surface s = surfaces.surface_at(hit->triangle, hit->barycentrics);
        const bool back = dot(s.geometric_normal, direction) > 0;
        const float side = back ? -1.0f : 1.0f;
        points.push_back({s, side * s.geometric_normal, side * s.normal, -direction, pixel, hit->triangle,
                          hit->barycentrics,
                          map.behind_cuts(map.grid_of_side[2 * hit->triangle + (back ? 1 : 0)], s.position)});
    }
    return points;
}

}  // namespace lw
