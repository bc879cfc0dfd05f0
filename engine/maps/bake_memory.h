// Predicts the memory that a bake will take, so that a bake that cannot finish is refused before it starts.
#pragma once
#include "maps/photon_map.h"
#include "trace/ray_caster.h"

namespace lw {

/// Peak bytes of shoot_photons and build_photon_map together, the scene included. A model fitted to measured bakes: at
/// least what they take, at most about twice as much (tests/maps/bake_memory_test.cpp).
uint64_t predict_bake_bytes(const Scene& scene, const RayCaster& caster, const BakeSettings& settings);

/// Throws Error when the bake would take more than `budget` bytes, or more than 2^32 references, nodes or words of lamp
/// bits. The message says how many photons would fit.
void check_bake_fits(const Scene& scene, const RayCaster& caster, const BakeSettings& settings, uint64_t budget);

}  // namespace lw
