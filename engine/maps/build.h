// Builds the photon map from photons: patches with 2D grids, lattices with light at their nodes (docs/method.md).
#pragma once
#include "maps/photon_map.h"
#include "photons/photon.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace lw {

/// The area of all triangles, one side each, m2.
double area_of(const Scene& scene);

/// Builds the maps. With a radius of 0 in the settings resolution follows the surroundings and the density of photons.
/// Directions are kept only when a surface of
/// the scene needs them (a specular lobe or a normal map). Same input gives the same bytes at any thread count.
PhotonMap build_photon_map(const Scene& scene, const RayCaster& caster, const Photons& photons, BakeSettings wanted);

/// True when a surface of the scene has a specular lobe or a normal map, so that its radiance depends on the direction
/// of photons.
bool needs_directions(const Scene& scene);

}  // namespace lw
