// Small JSON files beside a scene: read whole, written whole or not at all. nlohmann/json behind two functions.
#pragma once
#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lw {

/// Throws Error naming the file when it is missing, larger than 64 MiB or not JSON.
nlohmann::json read_json(const std::filesystem::path& path);

/// Indented by two spaces. Throws Error naming the file when it cannot be written.
void write_json(const std::filesystem::path& path, const nlohmann::json& value);

/// The number `key` of an entry, or `otherwise` without one. Throws Error naming `where` when it is no number up to
/// 1e9.
double number_in(const nlohmann::json& entry, const char* key, const std::string& where, double otherwise);
/// "position": [x, y, z] of an entry, m. Throws Error naming `where` when there is none.
glm::dvec3 position_in(const nlohmann::json& entry, const std::string& where);
/// The list of objects `key` of a file. Throws Error naming `where` when there is none.
const nlohmann::json& list_in(const nlohmann::json& file, const char* key, const std::string& where);

/// "SCENE.glb", "ambiances" -> SCENE.ambiances.json beside it.
std::filesystem::path json_beside(const std::filesystem::path& scene, const std::string& what);

}  // namespace lw
