// Whether a scene and its map fit on a device: asked before anything is allocated.
#pragma once
#include <string>

#include "gather/resident.h"
#include "maps/photon_map.h"
#include "scene/scene.h"

namespace lw {

/// Throws Error telling what the device lacks, or what would fit into its memory. `queries_rays`:
/// Resident::queries_rays().
void check_device(const Device& device, const Scene& scene, const PhotonMap& map, bool queries_rays);

/// The size, when so many pictures of it fit beside the resident scene, into the device's memory and, once, into that
/// of the machine; else throws Error telling which size would.
vk::Extent2D fit_pictures(const Device& device, const Resident& resident, vk::Extent2D size, uint pictures);

/// Rounded up, with its unit.
std::string mebibytes(uint64_t bytes);

}  // namespace lw
