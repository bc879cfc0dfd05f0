// A floor, and photons laid on surfaces at known places: what light brings to them follows in closed form.
#pragma once
#include <optional>
#include <vector>

#include "benchmark/lab_scene.h"
#include "photons/photon.h"
#include "trace/ray_caster.h"

namespace lw::test {

/// A floor of 6 x 6 m under the sky, in two triangles, and two point lamps.
inline Scene floor_with_two_lamps() {
    LabScene lab;
    lab.add_rectangle("floor", vec3(0), vec3(0, 0, 6), vec3(6, 0, 0), 0.5f);
    lab.add_point(vec3(3, 2, 3), 100);
    lab.add_point(vec3(1, 2, 1), 100);
    return lab.finish();
}

/// A photon that came straight down to the first surface below `from`.
inline std::optional<Photon> photon_below(const RayCaster& caster, vec3 from, uint lamp, uint path = path_indirect) {
    const std::optional<Hit> hit = caster.nearest(from, vec3(0, -1, 0));
    if (!hit) return {};
    return Photon{from - vec3(0, hit->distance, 0), vec3(1), vec3(0, 1, 0), hit->triangle,
                  pack_origin(lamp, path, false)};
}

/// Photons `apart` m from each other in rows on the square between `low` and `high` (x and z), each with the flux of
/// its share of 1 lux.
inline std::vector<Photon> photons_in_rows(const RayCaster& caster, float low, float high, float apart, uint lamp,
                                           uint path) {
    std::vector<Photon> photons;
    const int count = int((high - low) / apart + 0.5f);
    for (int x = 0; x < count; ++x)
        for (int z = 0; z < count; ++z) {
            const vec3 from(low + (float(x) + 0.5f) * apart, 1, low + (float(z) + 0.5f) * apart);
            photons.push_back(*photon_below(caster, from, lamp, path));
            photons.back().flux = vec3(apart * apart);
        }
    return photons;
}

}  // namespace lw::test
