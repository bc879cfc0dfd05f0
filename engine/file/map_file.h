// The photon map file (.pmap), described in docs/map-format.md: header, scalars, then bounds-checked sections whose
// records are the GPU's records. Little-endian.
#pragma once
#include <filesystem>

#include "maps/photon_map.h"
#include "scene/scene.h"

namespace lw {

/// Writes the map to `path`. It is written beside that and then renamed, so an old file is only replaced by a complete
/// one. Throws Error naming the file.
void save_photon_map(const std::filesystem::path& path, const PhotonMap& map);

/// Reads and checks a map: magic, version, sizes, checksum, every index, and that it was baked from `scene`.
/// Throws Error("file: what") saying whether the map was damaged or the scene changed.
PhotonMap load_photon_map(const std::filesystem::path& path, const Scene& scene);

/// The default file of a scene's map: SCENE.pmap beside SCENE.glb.
std::filesystem::path default_map_path(const std::filesystem::path& scene);

}  // namespace lw
