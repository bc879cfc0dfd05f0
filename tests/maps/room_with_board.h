// A baked room with a board above its floor, two point lamps and a spot, and where these light it by brute force.
#pragma once
#include "maps/baked_lab.h"

namespace lw::test {

inline const BakedLab& room_with_board() {
    static const BakedLab baked = [] {
        LabScene lab;
        lab.add_room(vec3(0), vec3(6, 3, 4), 0.5f);
        lab.add_rectangle("board", vec3(2.2f, 0.9f, 1.4f), vec3(0, 0, 1), vec3(1.3f, 0, 0), 0.5f);
        lab.add_point(vec3(3.1f, 2.6f, 2.2f), 100);
        lab.add_point(vec3(0.7f, 1.9f, 0.9f), 100);
        lab.add_spot(vec3(4.6f, 2.8f, 1.7f), vec3(0, -1, 0), 100, 20, 30);
        return BakedLab(lab.finish(), {.photons = 50'000, .radius = 0.4f});
    }();
    return baked;
}

inline bool is_lit(const BakedLab& lab, vec3 p, vec3 normal, const Light& lamp) {
    const vec3 to_lamp = lamp.position - p;
    if (dot(to_lamp, normal) <= 0) return false;
    if (lamp.type == light_spot && -dot(normalize(to_lamp), lamp.direction) <= lamp.cos_outer) return false;
    return !is_blocked(lab, glm::dvec3(p + 1e-4f * normal), glm::dvec3(lamp.position));
}

/// Whether a place is so close to the border of a shadow that rounding decides.
inline bool is_at_border(const BakedLab& lab, vec3 p, const SurfaceGrid& grid, const Light& lamp) {
    const bool lit = is_lit(lab, p, grid.normal, lamp);
    for (const vec3 aside : {grid.u_axis, -grid.u_axis, grid.v_axis, -grid.v_axis})
        if (is_lit(lab, p + 2e-3f * aside, grid.normal, lamp) != lit) return true;
    return false;
}

/// What a node's surroundings see of a lamp, and above own_shift what it sees itself.
inline uint bits_of(const PhotonMap& map, uint lamps, uint node, uint lamp) {
    return map.visible_lamps[node * visibility_row_length(lamps) + visibility_column(lamp)] >> visibility_shift(lamp) &
           15u;
}

}  // namespace lw::test
