// Checks of a map file before anything else reads it: every index lies in its array, every number is finite, every way
// through the records ends (docs/map-format.md).
#pragma once
#include <filesystem>
#include <string>

#include "file/grid_records.h"
#include "scene/scene.h"

namespace lw {

/// Throws Error("path: what; bake the map again").
[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what);

/// True for a length or coordinate, m, with which the shaders can compute without infinities.
bool is_place(float metres);

/// True for a scale of packed records by which light can be divided without infinities: 2^-100 to 2^100.
bool is_scale(float scale);

/// Throws Error when a record is not valid or refers to a record or cell that does not exist. `map` must hold all other
/// sections.
void check_records(const std::filesystem::path& path, const GridRecords& file, const PhotonMap& map,
                   const Scene& scene);

/// Throws Error when the arrays of a map do not agree with each other or with the scene. The map must have its grids
/// and cuts.
void check_map(const std::filesystem::path& path, PhotonMap& map, const Scene& scene);

}  // namespace lw
