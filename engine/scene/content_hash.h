// A 64-bit fingerprint of everything a photon map depends on, so that a map is never shown with another scene.
#pragma once
#include <cstdint>

#include "scene/scene.h"

namespace lw {

/// Hash of geometry, materials, textures and the lamps' places and shapes. Lamp strengths and cameras do not count,
/// nor does the strength of an emissive material: photons are stored for lamps of unit power.
uint64_t content_hash(const Scene& scene);

}  // namespace lw
