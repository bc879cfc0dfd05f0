// What a map file must hold before anything reads it: no index leads out of its array, no number is none, nothing runs
// on without end (docs/map-format.md).
#pragma once
#include <filesystem>
#include <string>

#include "file/grid_records.h"
#include "scene/scene.h"

namespace lw {

/// Throws Error("path: what; bake the map again").
[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what);

/// Whether a length or coordinate, m, is one that the shaders can compute with.
bool is_place(float metres);

/// Whether the scale of a packed record lets light divided by it stay a number.
bool is_scale(float scale);

/// Refuses records that are not valid by themselves, or refer to others or to cells that do not exist. `map` has all
/// other sections.
void check_records(const std::filesystem::path& path, const GridRecords& file, const PhotonMap& map,
                   const Scene& scene);

/// Refuses a map, which has its grids and cuts, whose arrays do not agree with each other or with the scene.
void check_map(const std::filesystem::path& path, PhotonMap& map, const Scene& scene);

}  // namespace lw
