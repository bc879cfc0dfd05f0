// Follows the photons of a lamp from surface to surface, and stores them.
#pragma once
#include <array>
#include <limits>
#include <vector>

#include "photons/emission_guide.h"
#include "photons/packed_triangles.h"
#include "photons/photon.h"
#include "photons/shoot.h"
#include "trace/bsdf.h"
#include "trace/emitter.h"

namespace lw {

/// One task: the paths [first, last) of a lamp, with the photons they left and their energy balance.
struct Chunk {
    uint light;
    uint64_t first, last;
    std::vector<Photon> photons;
    double emitted_flux = 0, absorbed = 0, escaped = 0;
    uint64_t shown = 0;  // hits of surfaces that can show light (not mirrors or clear glass)
};

/// Traces the paths of photons. Scene and caster must outlive it. Thread-safe, except for guide().
class PhotonTracer {
  public:
    PhotonTracer(const Scene& scene, const RayCaster& caster, const ShootSettings& settings);

    void guide(uint light, EmissionGuide guide) { guides_[light] = std::move(guide); }

    /// The five numbers in [0, 1) that path `index` of a lamp is emitted with, before the guide changes them:
    /// Owen-scrambled Sobol.
    std::array<float, 5> numbers(uint light, uint64_t index) const;

    /// Traces the paths of a chunk, several at a time; each carries 1 / `emitted` of the lamp's flux. No new path is
    /// started once the chunk holds `most` photons; chunk.last is then set to the first path that was not started.
    void trace(Chunk& chunk, double emitted, size_t most = std::numeric_limits<size_t>::max()) const;

  private:
    struct PathState;
    struct Bounce;
    PathState start(Chunk& chunk, uint64_t index, float share) const;
    bool look(Chunk& chunk, PathState& state) const;
    bool bounce(Chunk& chunk, PathState& state) const;
    void pass_medium(Chunk& chunk, PathState& state, const Bounce& at) const;
    void keep(Chunk& chunk, const PathState& state, const Bounce& at) const;
    Bounce bounce_at(const Hit& hit, vec3 direction) const;
    bool leave(Chunk& chunk, PathState& state, const Bounce& at) const;
    bool leave_matte(Chunk& chunk, PathState& state, const Bounce& at) const;
    static void note_reflector(PathState& state, const Bounce& at);
    static bool survives(Chunk& chunk, PathState& state, vec3 weight, float max_survival);
    void read_matte(const Hit& hit, const PackedTriangle& packed, Surface& s) const;

    const Scene& scene_;
    const RayCaster& caster_;
    SurfaceReader surfaces_;
    Emitters emitters_;
    std::vector<EmissionGuide> guides_;
    std::vector<PackedTriangle> packed_triangles_;
    ShootSettings settings_;
};

}  // namespace lw
