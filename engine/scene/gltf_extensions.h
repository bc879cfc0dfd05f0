// Which glTF extensions the loader reads, and what it does about the others.
#pragma once
#include <string>

#include "scene/gltf_file.h"

namespace lw {

/// True when the loader gives this extension its meaning, or a stated substitute for it.
bool reads_extension(const std::string& extension);

/// True when ignoring the extension may change the picture, so that the user should be told.
bool changes_look(const std::string& extension);

/// True when an extension that is not known may hold or move triangles, as its name says: a file that requires it
/// cannot be shown in its true shape.
bool may_change_geometry(const std::string& extension);

/// Gives the primitives the materials of a variant (KHR_materials_variants). Throws Error, with the names there are,
/// for one that the file does not have.
void choose_variant(GltfFile& file, const std::string& variant);

}  // namespace lw
