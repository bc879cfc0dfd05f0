// The numbers of materials, lamps and cameras: of the type and in the range that glTF gives them.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "scene/gltf_file.h"

namespace lw {

/// Throws Error for a number of the wrong type or length, which the parser would silently take for its default, and for
/// light that would be negative; warns of factors out of range, of which the nearest that is possible is taken.
void check_ranges(GltfFile& file, const nlohmann::json& root);

}  // namespace lw
