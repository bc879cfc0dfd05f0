// The light of one lamp at any point of a surface, from what the nodes of the lattices know of it.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "maps/lattice.h"
#include "trace/emitter.h"

namespace lw {

/// Reads the nodes of one lamp. All references must outlive it. Thread-safe.
class SeenLight {
  public:
    /// `nodes`: lux of the lamp at intensity 1 at each node, without the direct light of a lamp that has no surface;
    /// that light is added where `visible_lamps` (of find_visibility()) says that it arrives.
    SeenLight(const Scene& scene, const Lattice& lattice, const std::vector<uint>& visible_lamps, uint lamp,
              std::span<const vec3> nodes);

    /// Irradiance, lux for intensity 1 of the lamp, at a point of a side of a triangle (2 x triangle, + 1 for its
    /// back); nullopt where the side has
    /// no lattice: nobody knows then.
    std::optional<vec3> irradiance(uint side, vec3 position) const;

  private:
    bool sees_lamp(uint node) const;

    const Scene& scene_;
    const Lattice& lattice_;
    const std::vector<uint>& visible_lamps_;
    uint lamp_;
    std::span<const vec3> nodes_;
    Emitters emitters_;
};

}  // namespace lw
