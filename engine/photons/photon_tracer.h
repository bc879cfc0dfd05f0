// Follows the photons of a lamp from surface to surface, and stores them.
#pragma once
#include <array>
#include <limits>
#include <vector>

#include "photons/aim.h"
#include "photons/facets.h"
#include "photons/photon.h"
#include "photons/shoot.h"
#include "trace/bsdf.h"
#include "trace/emitter.h"

namespace lw {

/// One task: paths [first, last) of a lamp, and what became of them.
struct Chunk {
    uint light;
    uint64_t first, last;
    std::vector<Photon> photons;
    double emitted_flux = 0, absorbed = 0, escaped = 0;
    uint64_t shown = 0;  // hits of surfaces that can show light
};

/// Luminance of a flux, for balances.
double balance_of(vec3 flux);

/// Scene and caster must outlive it. Thread-safe but for aim().
class PhotonTracer {
  public:
    PhotonTracer(const Scene& scene, const RayCaster& caster, const ShootSettings& settings);

    void aim(uint light, Aim aim) { aims_[light] = std::move(aim); }

    /// The five emission numbers of a path, before aiming: Owen-scrambled Sobol.
    std::array<float, 5> numbers(uint light, uint64_t index) const;

    /// Traces the paths of a chunk, a few side by side; each carries 1 / emitted of the lamp's flux. With `most`
    /// photons no more paths are started; chunk.last becomes the first that was not.
    void trace(Chunk& chunk, double emitted, size_t most = std::numeric_limits<size_t>::max()) const;

  private:
    struct Flight;
    struct Bounce;
    Flight start(Chunk& chunk, uint64_t index, float share) const;
    bool look(Chunk& chunk, Flight& flight) const;
    bool bounce(Chunk& chunk, Flight& flight) const;
    void pass_medium(Chunk& chunk, Flight& flight, const Bounce& at) const;
    void keep(Chunk& chunk, const Flight& flight, const Bounce& at) const;
    Bounce bounce_at(const Hit& hit, vec3 direction) const;
    bool leave(Chunk& chunk, Flight& flight, const Bounce& at) const;
    bool leave_matte(Chunk& chunk, Flight& flight, const Bounce& at) const;
    static bool survives(Chunk& chunk, Flight& flight, vec3 weight, float longest_survival);
    void read_matte(const Hit& hit, const Facet& facet, Surface& s) const;

    const Scene& scene_;
    const RayCaster& caster_;
    SurfaceReader surfaces_;
    Emitters emitters_;
    std::vector<Aim> aims_;
    std::vector<Facet> facets_;
    ShootSettings settings_;
};

}  // namespace lw
