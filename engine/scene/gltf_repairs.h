// What tinygltf refuses though the specification allows it, changed in the JSON of a glTF file before it is parsed.
#pragma once
#include <nlohmann/json_fwd.hpp>

namespace lw {

/// Gives images that cannot be read bytes that are no picture, fallback buffers of compressed views a byte, and
/// accessors of primitives compressed by Draco the compressed view. Returns true when anything was changed.
bool repair_for_tinygltf(nlohmann::json& root);

}  // namespace lw
