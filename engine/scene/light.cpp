#include "scene/light.h"

#include <algorithm>
#include <cmath>

#include "scene/surface.h"

namespace lw {

const char* unit_of(LightType type) {
    switch (type) {
        case light_point:
        case light_spot:
        case light_profile:
            return "cd";
        case light_directional:
            return "lx";
        case light_mesh:
            return "cd/m2";
    }
    return "";
}

double max_usual_intensity(LightType type) {
    switch (type) {
        case light_point:
        case light_spot:
        case light_profile:
            return 1e7;
        case light_directional:
            return 2e5;
        case light_mesh:
            return 1e6;
    }
    return 0;
}

const char* distribution_text(LightType type) {
    switch (type) {
        case light_point:
            return "the same on all sides";
        case light_spot:
            return "a spot of the scene file";
        case light_directional:
            return "parallel";
        case light_mesh:
            return "a glowing surface";
        case light_profile:
            return "a table";
    }
    return "";
}

float radius_around(const Scene& scene) { return 0.5f * length(scene.bounds[1] - scene.bounds[0]) * 1.001f; }

float unit_flux(const Scene& scene, const Light& light) {
    switch (light.type) {
        case light_point:
            return 4 * lw_pi;
        case light_spot:  // the integral of the squared falloff
            return 2 * lw_pi * ((1 - light.cos_inner) + (light.cos_inner - light.cos_outer) / 3);
        case light_directional:
            return lw_pi * radius_around(scene) * radius_around(scene);
        case light_mesh:
            return lw_pi * light.area;
        case light_profile:
            return cells_of_profile(scene, light).flux_below.back();
    }
    return 0;
}

ProfileCells cells_of_profile(const Scene& scene, const Light& light) {
    const SurfaceReader surfaces(scene);
    // A round distribution has one column, which is cut so that no cell goes all around.
    ProfileCells cells{std::max(scene.texels[light.profile], 4u), scene.texels[light.profile + 1] - 1, {}};
    const uint step = scene.texels[light.profile] == 1 ? 0 : 1;
    double sum = 0;
    for (uint c = 0; c < cells.columns; ++c)
        for (uint r = 0; r < cells.rows; ++r) {
            const float low = lw_pi * float(r) / float(cells.rows), high = lw_pi * float(r + 1) / float(cells.rows);
            const double area = double(std::cos(low) - std::cos(high)) * 2 * double(lw_pi) / cells.columns;
            const auto at = [&](uint i, uint j) { return double(surfaces.profile_entry(light.profile, i * step, j)); };
            sum += area * (at(c, r) + at(c + 1, r) + at(c, r + 1) + at(c + 1, r + 1)) / 4;
            cells.flux_below.push_back(float(sum));
        }
    return cells;
}

}  // namespace lw
