// Small JSON files beside a scene: read whole, written whole or not at all. nlohmann/json behind two functions.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace lw {

/// Throws Error naming the file when it is missing, larger than 64 MiB or not JSON.
nlohmann::json read_json(const std::filesystem::path& path);

/// Indented by two spaces. Throws Error naming the file when it cannot be written.
void write_json(const std::filesystem::path& path, const nlohmann::json& value);

/// "SCENE.glb", "ambiances" -> SCENE.ambiances.json beside it.
std::filesystem::path json_beside(const std::filesystem::path& scene, const std::string& what);

}  // namespace lw
