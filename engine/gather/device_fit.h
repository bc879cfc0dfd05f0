// Checks whether a scene and its map fit on a device, before anything is allocated.
#pragma once
#include <string>

#include "gather/resident.h"
#include "maps/photon_map.h"
#include "scene/scene.h"

namespace lw {

/// Throws Error when a limit or the memory of the device is too small, saying what is missing or how many photons would
/// fit. `queries_rays`: rays will be traced by ray queries.
void check_device(const Device& device, const Scene& scene, const PhotonMap& map, bool queries_rays);

/// Returns `size` when that many `pictures` of it fit into the device's memory beside the resident scene, and one of
/// them into the machine's memory. Otherwise throws Error saying which size would fit.
vk::Extent2D fit_pictures(const Device& device, const Resident& resident, vk::Extent2D size, uint pictures);

/// A size as text in MiB, rounded up.
std::string mebibytes(uint64_t bytes);

}  // namespace lw
