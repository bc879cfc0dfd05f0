// Hostile bytes into the loaders: what the fuzzers and the replay of their corpora do with one input. Refusal by Error
// is right; what is accepted must be usable without reading out of bounds. Anything else escapes as std::logic_error.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "maps/photon_map.h"
#include "scene/scene.h"

namespace lw::test {

using Bytes = std::span<const uint8_t>;

/// Loads the bytes as a .gltf or .glb without files around it and looks at its surfaces and lamps. The scene if it was
/// accepted.
std::optional<Scene> feed_gltf(Bytes bytes);

/// The scene that the maps of feed_map belong to: data/cube.gltf.
const Scene& scene_of_maps();

/// Loads the bytes as a photon map of scene_of_maps(), its scene hash and checksum set right first, and estimates light
/// on every triangle in every mode. The map if it was accepted.
std::optional<PhotonMap> feed_map(Bytes bytes);

/// Gives the bytes of a map file the checksum of their present content; no change when they are too short.
void sign_map(std::string& bytes);

}  // namespace lw::test
