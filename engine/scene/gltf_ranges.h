// Checks that the numbers of materials, lamps and cameras have the type and range that glTF prescribes.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "scene/gltf_file.h"

namespace lw {

/// Throws Error for a value of the wrong type or length, for which the parser would silently use the default, and for
/// negative light. Warns about other factors out of range; the nearest allowed value is used for them.
void check_ranges(GltfFile& file, const nlohmann::json& root);

}  // namespace lw
