// Reads and writes small JSON files beside a scene. A file is written completely or not at all.
#pragma once
#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lw {

/// Reads and parses a file. Throws Error naming the file when it is missing, larger than 64 MiB or not JSON.
nlohmann::json read_json(const std::filesystem::path& path);

/// Writes a value, indented by two spaces. Throws Error naming the file when it cannot be written.
void write_json(const std::filesystem::path& path, const nlohmann::json& value);

/// The number `key` of an entry, or `otherwise` without one. Throws Error naming `where` when it is no number up to
/// 1e9.
double number_in(const nlohmann::json& entry, const char* key, const std::string& where, double otherwise);
/// The member "position": [x, y, z] of an entry, m. Throws Error naming `where` when it is missing or malformed.
glm::dvec3 position_in(const nlohmann::json& entry, const std::string& where);
/// The list of objects `key` of a file. Throws Error naming `where` when there is none.
const nlohmann::json& list_in(const nlohmann::json& file, const char* key, const std::string& where);

/// The path of a JSON file beside a scene: ("SCENE.glb", "ambiances") gives SCENE.ambiances.json.
std::filesystem::path json_beside(const std::filesystem::path& scene, const std::string& what);

}  // namespace lw
