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

/// In float or, as float does not part the cosines near a pole, in double for rows finer than half a degree.
template <class T>
ProfileDirection in_profile_row_by(uint row, uint rows, float within) {
    const T low = std::cos(T(lw_pi) * T(row) / T(rows)), high = std::cos(T(lw_pi) * T(row + 1) / T(rows));
    const T cosine = low + T(within) * (high - low);
    return {float(cosine), float(std::sqrt(std::max(T(0), 1 - cosine * cosine))), float(low - high)};
}

ProfileDirection in_profile_row(uint row, uint rows, float within) {
    return rows > 360 ? in_profile_row_by<double>(row, rows, within) : in_profile_row_by<float>(row, rows, within);
}

ProfileCells cells_of_profile(const Scene& scene, const Light& light) {
    constexpr size_t max_cells = 131'072;  // of more, the running sum of flux in float loses some
    const SurfaceReader surfaces(scene);
    // A round distribution has one column, which is cut so that no cell goes all around.
    const uint columns = std::max(scene.texels[light.profile], 4u), rows = scene.texels[light.profile + 1] - 1;
    const uint step = scene.texels[light.profile] == 1 ? 0 : 1;
    ProfileCells cells{columns, rows, {}};
    // Halved on the wider side: there the light varies less.
    while (size_t(cells.columns) * cells.rows > max_cells) {
        const bool wide = 2 * cells.rows > cells.columns;
        uint &wider = wide ? cells.columns : cells.rows, &other = wide ? cells.rows : cells.columns;
        uint& halved = wider % 2 == 0 ? wider : other;
        if (halved % 2 != 0) break;
        halved /= 2;
    }
    double sum = 0;
    const auto at = [&](uint i, uint j) { return double(surfaces.profile_entry(light.profile, i * step, j)); };
    const auto add_cell = [&](uint c, uint r) {
        const double area = double(in_profile_row(r, rows, 0).band) * 2 * double(lw_pi) / columns;
        sum += area * (at(c, r) + at(c + 1, r) + at(c, r + 1) + at(c + 1, r + 1)) / 4;
    };
    const uint across = columns / cells.columns, along = rows / cells.rows;
    for (uint i = 0; i < columns; i += across)
        for (uint j = 0; j < rows; j += along) {
            for (uint c = i; c < i + across; ++c)
                for (uint r = j; r < j + along; ++r) add_cell(c, r);
            cells.flux_below.push_back(float(sum));
        }
    return cells;
}

}  // namespace lw
