// Photons -> per-triangle (or per-patch) 2D uniform grids: the photon map (paper, section 2.2).
#pragma once
#include "maps/photon_map.h"
#include "photons/photon.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace lw {

/// Area of all triangles, one side, m2.
double area_of(const Scene& scene);

/// The radius within which 250 photons lie at the mean density of the scene: sqrt(250 A / (pi N)).
/// Bounded by half the diagonal of the scene.
float automatic_radius(const Scene& scene, uint64_t photons);

/// Builds the maps. settings.radius of 0 is replaced by the automatic radius;
/// small patches get a smaller one while references per photon exceed 2.3.
/// Directions are kept only when a surface of
/// the scene needs them (a specular lobe or a normal map). Same input gives the same bytes at any thread count.
PhotonMap build_photon_map(const Scene& scene, const RayCaster& caster, const Photons& photons, BakeSettings wanted);

/// True when reflected radiance depends on the direction of the photons.
bool needs_directions(const Scene& scene);

}  // namespace lw
