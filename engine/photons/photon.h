// A photon: the record that a light path leaves on a surface.
#pragma once
#include <cstdint>
#include <vector>

#include "shaders/photon_map.h"

namespace lw {

/// A path class like path_caustic, but with at least one bounce by a narrow lobe that is no mirror. Such a caustic is
/// nearly as sharp; rays along the lobes of glossy surfaces find it too.
constexpr uint path_near_caustic = 3;

inline bool is_caustic(uint path) { return path == path_caustic || path == path_near_caustic; }

constexpr uint no_reflector = ~0u;

struct Photon {
    vec3 position;
    vec3 flux;          // lm per unit intensity of its lamp, per RGB
    vec3 from;          // unit direction it came from
    uint triangle;      // struck triangle
    uint origin;        // pack_origin(): lamp, path class, struck side
    vec3 reflector{0};  // the place at which a surface reflected it last to all sides (reflects_to_all_sides())
    uint reflector_side = no_reflector;  // 2 x triangle of that surface, + 1 for its back

    uint light() const { return origin & light_mask; }
    uint path() const {
        return (origin >> path_shift) & 3u;
    }                                           // path_direct, path_indirect, path_caustic, path_near_caustic
    uint side() const { return origin >> 16; }  // 0: front of the triangle, 1: back
};

/// Prefetches a photon that will be read soon. It may lie across two cache lines.
inline void prefetch(const Photon& photon) {
    __builtin_prefetch(&photon);
    __builtin_prefetch(reinterpret_cast<const char*>(&photon + 1) - 1);
}

inline uint pack_origin(uint light, uint path, bool back) {
    return light | path << path_shift | (back ? 1u << 16 : 0u);
}

/// The energy balance of one lamp at unit intensity. Fluxes are luminances of the RGB flux.
struct LightBalance {
    uint64_t emitted = 0;  // photons
    uint64_t stored = 0;   // photons
    double flux_out = 0;   // lm leaving the lamp
    double absorbed = 0;   // lm absorbed: not reflected by a material, or ended by Russian roulette
    double escaped = 0;    // lm leaving the scene
};

struct Photons {
    std::vector<Photon> records;
    std::vector<LightBalance> lights;
};

}  // namespace lw
