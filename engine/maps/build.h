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

/// Builds the photon map. A radius of 0 in the settings is replaced by automatic_radius(); small patches get a smaller
/// one until there are fewer than 2.3 references per photon. Directions of photons are kept only when
/// needs_directions(). The same input gives the same bytes at any thread count. Throws Error when a given radius is too
/// small for the scene.
PhotonMap build_photon_map(const Scene& scene, const RayCaster& caster, const Photons& photons, BakeSettings wanted);

/// True when a surface of the scene has a specular lobe or a normal map, so that its radiance depends on the direction
/// of photons.
bool needs_directions(const Scene& scene);

}  // namespace lw
