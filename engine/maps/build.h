// Builds the photon map from photons: patches with 2D grids, lattices with light at their nodes (docs/method.md).
#pragma once
#include "maps/photon_map.h"
#include "photons/photon.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace lw {

/// The area of all triangles, one side each, m2.
double area_of(const Scene& scene);

/// The largest search radius of a bake that was given none, m: that of a disc with 250 photons at their mean density,
/// sqrt(250 A / (pi N)), but at most half the diagonal of the scene.
float automatic_radius(const Scene& scene, uint64_t photons);

/// Builds the maps. settings.radius of 0 is replaced by the automatic radius;
/// small patches get a smaller one while references per photon exceed 2.3.
/// Directions are kept only when a surface of
/// the scene needs them (a specular lobe or a normal map). Same input gives the same bytes at any thread count.
PhotonMap build_photon_map(const Scene& scene, const RayCaster& caster, const Photons& photons, BakeSettings wanted);

/// True when a surface of the scene has a specular lobe or a normal map, so that its radiance depends on the direction
/// of photons.
bool needs_directions(const Scene& scene);

}  // namespace lw
