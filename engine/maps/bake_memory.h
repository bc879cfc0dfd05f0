// How much memory a bake will take, asked before it starts: a bake that cannot end is refused in its first second.
#pragma once
#include "maps/photon_map.h"
#include "scene/scene.h"

namespace lw {

/// Peak bytes of shoot_photons and build_photon_map together, the scene included. A model fitted to measured bakes: at
/// least what they take, at most about twice as much (tests/maps/bake_memory_test.cpp).
uint64_t predict_bake_bytes(const Scene& scene, const BakeSettings& settings);

/// Throws Error when the bake would take more than `budget` bytes, or count more than 2^32 references, nodes or lamp
/// bits, saying how many photons would do.
void check_bake_fits(const Scene& scene, const BakeSettings& settings, uint64_t budget);

}  // namespace lw
